// What tag, picture, both and a learned regressor tell: the kind from end to end, on a few fabrics.
#include <nlohmann/json.hpp>

#include "core/records.h"
#include "tests/experiments/program_fixture.h"

namespace drape {
namespace {

using TagComparison = ProgramInFolder;

TEST_F(TagComparison, ComparesAllOnTheSameFabrics) {
  const std::string arguments = std::string("run ") + DRAPE_SOURCE_DIR +
                                "/experiments/configs/tag_comparison.toml --out a --threads 1"
                                " --set mesh.vertices=250 --set start.protocol=lobes"
                                " --set dataset.pixels=32 --set tag_comparison.training=12"
                                " --set tag_comparison.held_out=3 --set estimate.max_iterations=8";
  const Ended ended = drape(arguments);
  ASSERT_EQ(ended.exit_code, 0) << ended.text;
  const auto comparison = nlohmann::json::parse(scratch.read("a/summary.json"))["comparison"];
  EXPECT_EQ(comparison["held_out"], 3);
  EXPECT_EQ(comparison["training"], 12);
  for (const char* parameter : {"k_u", "k_v", "k_h", "k_bu", "k_bv", "k_bh"})
    for (const char* method : {"tag", "picture", "both"})
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
}

}  // namespace
}  // namespace drape
