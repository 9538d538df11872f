// A folder of photographs: which captures are found and chosen, and what is known of their fabrics.
#include "experiments/photograph_study.h"

#include <gtest/gtest.h>

#include "tests/experiments/scratch_folder.h"

namespace drape {
namespace {

class PhotographStudy : public testing::Test {
 protected:
  void add(const std::string& place) const {
    std::filesystem::create_directories((scratch_ / place).parent_path());
    scratch_.write(place, "");
  }
  std::vector<std::string> found(const std::vector<int>& fabrics) const {
    std::vector<std::string> names;
    for (const Capture& c : find_captures(scratch_.path(), fabrics)) names.push_back(c.name());
    return names;
  }
  ScratchFolder scratch_;
};

TEST_F(PhotographStudy, FindsCapturesInTheOrderOfTheirNumbers) {
  for (const char* place :
       {"fabric_02/specimen_01_capture_10.jpg", "fabric_02/specimen_01_capture_2.jpg",
        "fabric_01/specimen_02_capture_1.png", "fabric_01/notes.txt",
        "fabric_01/old/specimen_01_capture_1.jpg", "fabric_x/specimen_01_capture_1.jpg",
        "fabric_99999999999/specimen_01_capture_1.jpg"})
    add(place);
  EXPECT_EQ(found({}), (std::vector<std::string>{"01_02_1", "02_01_2", "02_01_10"}));
  EXPECT_EQ(found({2}), (std::vector<std::string>{"02_01_2", "02_01_10"}));
}

TEST_F(PhotographStudy, AFabricThatIsNotThereIsNamed) {
  add("fabric_02/specimen_01_capture_1.jpg");
  try {
    find_captures(scratch_.path(), {2, 7});
    FAIL() << "nothing was thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("names fabric 7"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("fabric_07/specimen_SS"), std::string::npos);
  }
}

TEST_F(PhotographStudy, ChoosesOneCaptureOfEveryChange) {
  std::vector<Capture> all;
  for (int specimen = 1; specimen <= 2; ++specimen)
    for (int capture = 1; capture <= 4; ++capture) all.push_back({5, specimen, capture, ""});
  std::vector<std::string> names;
  for (const Capture& c : chosen_captures(all, 5)) names.push_back(c.name());
  EXPECT_EQ(names,
            (std::vector<std::string>{"05_01_1", "05_01_2", "05_01_3", "05_02_1", "05_01_4"}));
  EXPECT_EQ(chosen_captures(all, 1).size(), 1u);
  EXPECT_EQ(chosen_captures(all, 100).size(), all.size());
  EXPECT_EQ(change_between(all[0], all[1]), CaptureChange::placement);
  EXPECT_EQ(change_between(all[1], all[2]), CaptureChange::face);
  EXPECT_EQ(change_between(all[2], all[3]), CaptureChange::placement);
  EXPECT_EQ(change_between(all[0], all[6]), CaptureChange::specimen);
}

TEST(PhotographModelSettings, SayTheThresholdAndTheUnknowns) {
  const Settings base;
  EXPECT_EQ(with_model(base, PhotographModel::printed).reading.threshold,
            BendingThreshold::printed);
  const Settings radius = with_model(base, PhotographModel::radius);
  EXPECT_EQ(radius.reading.threshold, BendingThreshold::radius);
  EXPECT_EQ(radius.estimate.parameters, base.estimate.parameters);
  EXPECT_EQ(with_model(base, PhotographModel::radius_softening).estimate.parameters.size(),
            base.estimate.parameters.size() + 3);
}

TEST(PhotographDensity, IsTheFabricsOwnWhereItIsKnown) {
  Settings settings;
  settings.photographs.weighed = {2, 5};
  settings.photographs.densities = {0.192, 0.274};
  settings.photographs.areal_density = 0.15;
  EXPECT_EQ(areal_density_of(settings, 5), 0.274);
  EXPECT_EQ(areal_density_of(settings, 7), 0.15);
}

}  // namespace
}  // namespace drape
