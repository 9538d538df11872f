// What a tag tells by the fabrics of a results.h5: the command line, and the prior of fits.
#include "experiments/tag_dataset.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdio>

#include "estimation/random_tags.h"
#include "estimation/tag_model.h"
#include "experiments/dataset_fabrics.h"
#include "experiments/tag_names.h"
#include "experiments/tag_report.h"
#include "tests/experiments/program_fixture.h"
#include "tests/support/made_up_records.h"

namespace drape {
namespace {

constexpr const char* kTag = " --type jersey --composition 'Cotton 59, Modal 41' --density 0.104";

class TagDataset : public ProgramInFolder {
 protected:
  void SetUp() override {
    Random random(1);
    for (const Tag& tag : random_tags(60, 1))
      fabrics.push_back({tag, random_parameters(tag, BendingThreshold::radius, random)});
  }

  /// A table of those fabrics on a made-up mesh, each record twice if so.
  std::filesystem::path write(const std::string& name, bool twice = false) const {
    std::vector<Record> records;
    for (int i = 0; i < static_cast<int>(fabrics.size()) * (twice ? 2 : 1); ++i) {
      const TaggedFabric& fabric = fabrics[static_cast<size_t>(i) % fabrics.size()];
      Record record = test::make_record(i, header);
      copy_tag(tagged(fabric.tag, fabric.fabric), record);
      record.fabric = fabric.fabric;
      records.push_back(record);
    }
    write_records(scratch / name, header, records);
    return scratch / name;
  }

  void expect_refused(const std::string& arguments, const std::string& message) const {
    const Ended ended = drape(arguments);
    EXPECT_EQ(ended.exit_code, 2) << ended.text;
    EXPECT_TRUE(ended.says(message)) << ended.text;
  }

  RecordsHeader header = test::make_header();  // its thresholds are of the reading "radius"
  std::vector<TaggedFabric> fabrics;
};

TEST_F(TagDataset, CommandShowsParametersAndHowWellTheyArePredicted) {
  write("results.h5", true);
  const Ended ended = drape(std::string("tag --dataset results.h5") + kTag);
  ASSERT_EQ(ended.exit_code, 0) << ended.text;
  EXPECT_TRUE(ended.says("Jersey (Cut & Sew knit, Single), Cotton 59; Modal 41, 0.104 kg/m^2"));
  for (const Parameter p : all_parameters())
    EXPECT_TRUE(ended.says("\n" + std::string(name(p)) + " ")) << name(p);
  EXPECT_TRUE(ended.says("     R^2  unit"));
  EXPECT_TRUE(ended.says("       -  kg/m^2"));  // the weight is not learned
  EXPECT_TRUE(ended.says("\n60 fabrics of results.h5; in cross-validation ")) << ended.text;
  EXPECT_TRUE(ended.says("reading \"radius\""));

  const Prior prior =
      tag_regression(scratch / "results.h5")
          .predict({Parameter::k_h}, tag_from_words("jersey", "Cotton 59, Modal 41", 0.104));
  const double sd = std::sqrt(prior.covariance(0, 0));
  char row[64];
  std::snprintf(row, sizeof row, "k_h            %12.3g%12.3g%12.3g",
                std::exp(prior.mean[0] - 1.645 * sd), std::exp(prior.mean[0]),
                std::exp(prior.mean[0] + 1.645 * sd));
  EXPECT_TRUE(ended.says(row)) << row << "\n" << ended.text;
}

TEST_F(TagDataset, BadFilesAreRefused) {
  const std::string tag = std::string("tag --dataset results.h5") + kTag;
  expect_refused(tag, "results.h5");
  scratch.write("results.h5", "no HDF5");
  expect_refused(tag, "results.h5");
  fabrics[7].tag.type = "Jersy";
  write("results.h5");
  expect_refused(tag, "results.h5: fabric '7': unknown type 'Jersy'; did you mean 'Jersey'?");
  fabrics.resize(7);
  write("results.h5");
  expect_refused(tag, "results.h5: what a tag tells cannot be learned from 7 fabrics");
  for (TaggedFabric& fabric : fabrics) fabric.tag = {};
  write("results.h5");
  expect_refused(tag, "from 0 fabrics with a tag");
}

TEST_F(TagDataset, SpellingDoesNotMatter) {
  const Prior named = tag_regression(write("a.h5")).predict({Parameter::k_h}, fabrics[0].tag);
  for (TaggedFabric& fabric : fabrics) {
    fabric.tag.subcategory = "";
    for (char& letter : fabric.tag.type) letter = static_cast<char>(std::tolower(letter));
    for (Fibre& fibre : fabric.tag.composition)
      if (fibre.name == kElastane) fibre.name = "Lycra";
  }
  const Prior spelt =
      tag_regression(write("b.h5")).predict({Parameter::k_h}, in_known_words(fabrics[0].tag));
  EXPECT_EQ(named.mean, spelt.mean);
}

TEST_F(TagDataset, PriorIsTheModelOrTheRegression) {
  const std::vector<Parameter> parameters{Parameter::k_h, Parameter::k_bu};
  const Tag& tag = fabrics[0].tag;
  EstimateSettings settings;
  const TagPrior model = tag_prior(settings, BendingThreshold::radius);
  EXPECT_EQ(model(parameters, tag).mean,
            prior_from_tag(parameters, tag, BendingThreshold::radius).mean);
  settings.tag_dataset = write("a.h5");
  const TagPrior learned = tag_prior(settings, BendingThreshold::radius);
  EXPECT_EQ(learned(parameters, tag).mean,
            tag_regression(scratch / "a.h5").predict(parameters, tag).mean);
  EXPECT_THROW(tag_prior(settings, BendingThreshold::printed), std::invalid_argument);
}

TEST_F(TagDataset, ConfigKeyIsCheckedBeforeARunBegins) {
  fabrics.resize(7);
  write("few.h5");
  const std::string run = "estimate --dataset few.h5 --out out --set estimate.tag_dataset=few.h5";
  expect_refused(run, "only for estimate.prior, estimate.first or photograph.prior = ");
  expect_refused(run + " --set estimate.prior=tag", "few.h5: what a tag tells cannot be learned");
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

}  // namespace
}  // namespace drape
