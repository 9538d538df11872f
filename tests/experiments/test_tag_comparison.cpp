// What tag, picture, both and a learned regressor tell: the kind from end to end, on a few fabrics.
#include <nlohmann/json.hpp>

#include "core/records.h"
#include "experiments/dataset_fabrics.h"
#include "experiments/tag_dataset.h"
#include "tests/experiments/program_fixture.h"

namespace drape {
namespace {

using TagComparison = ProgramInFolder;

TEST_F(TagComparison, ComparesAllOnTheSameFabrics) {
  const std::string arguments = std::string("run ") + DRAPE_SOURCE_DIR +
                                "/experiments/configs/tag_comparison.toml --out a --threads 1"
                                " --set mesh.vertices=250 --set start.protocol=lobes"
                                " --set dataset.pixels=32 --set tag_comparison.training=24"
                                " --set tag_comparison.held_out=3 --set estimate.max_iterations=8";
  const Ended ended = drape(arguments);
  ASSERT_EQ(ended.exit_code, 0) << ended.text;
  const auto comparison = nlohmann::json::parse(scratch.read("a/summary.json"))["comparison"];
  EXPECT_EQ(comparison["held_out"], 3);
  EXPECT_EQ(comparison["training"], 24);
  EXPECT_EQ(comparison["regression"]["fabrics"], 24);
  for (const char* parameter : {"k_u", "k_v", "k_h", "k_bu", "k_bv", "k_bh"})
    for (const char* method : {"tag", "regression", "picture", "both"})
      EXPECT_GT(comparison["log_errors"][parameter][method][1], 0) << parameter << " " << method;
  EXPECT_TRUE(std::filesystem::exists(scratch / "a/tag_comparison.pdf"));

  // held-out fabrics are others, and a fit does not start from what it is to find
  const std::vector<Record> training = read_records(scratch / "a/training/results.h5"),
                            picture = read_records(scratch / "a/picture/results.h5"),
                            both = read_records(scratch / "a/both/results.h5");
  EXPECT_NE(to_vector(training[0].fabric), to_vector(both[0].fabric));
  for (size_t i = 0; i < both.size(); ++i) {
    ASSERT_TRUE(picture[i].estimate && both[i].estimate);
    EXPECT_EQ(to_vector(picture[i].fabric), to_vector(both[i].fabric));
    EXPECT_EQ(picture[i].estimate->start.areal_density, picture[i].fabric.areal_density);
    EXPECT_NE(picture[i].estimate->start.k_bh, picture[i].fabric.k_bh);
    EXPECT_NE(both[i].estimate->start.k_bh, both[i].fabric.k_bh);
    EXPECT_NE(both[i].estimate->start.k_bh, picture[i].estimate->start.k_bh);
  }

  // what the figure has of the regression is its word, and a fit may begin with it
  const TagRegression regression = tag_regression(scratch / "a/training/results.h5");
  const auto said = nlohmann::json::parse(scratch.read("a/tag_regression.json"));
  const Ended fitted = drape(
      "estimate --dataset a/held_out/results.h5 --out b --threads 1 --records 1"
      " --set estimate.first=tag --set estimate.prior=tag --set estimate.max_iterations=8"
      " --set estimate.tag_dataset=a/training/results.h5");
  ASSERT_TRUE(std::filesystem::exists(scratch / "b/results.h5")) << fitted.text;
  const Record fit = read_records(scratch / "b/results.h5").front();
  ASSERT_TRUE(fit.estimate);
  for (const Parameter p : {Parameter::k_u, Parameter::k_h, Parameter::k_bh}) {
    const double mean = regression.predict({p}, tag_of(fit)).mean[0];
    EXPECT_EQ(said["mean"][std::string(name(p))][1], mean);
    EXPECT_EQ(fit.estimate->start[p], std::exp(mean));
  }
  EXPECT_EQ(fit.estimate->start.areal_density, fit.fabric.areal_density);
}

}  // namespace
}  // namespace drape
