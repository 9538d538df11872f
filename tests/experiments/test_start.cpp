// Start protocols and branches as a config asks for them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/profile.h"
#include "experiments/config.h"
#include "experiments/start_outline.h"
#include "tests/experiments/scratch_folder.h"

namespace drape {
namespace {

Settings settings_of(const std::string& kind, const std::vector<std::string>& sets) {
  std::vector<Assignment> assignments{assignment_from_set("experiment.kind=" + kind)};
  for (const std::string& set : sets) assignments.push_back(assignment_from_set(set));
  return read_settings(std::nullopt, assignments);
}

void expect_refused(const std::string& kind, const std::vector<std::string>& sets,
                    const std::string& message) {
  try {
    settings_of(kind, sets);
    ADD_FAILURE() << "accepted: " << message;
  } catch (const ConfigError& error) {  // the program's exit code 2
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
  }
}

TEST(Start, WhatDoesNotFitTogetherIsRefused) {
  expect_refused("drape", {"start.protocol=guided"}, "either start.outline or start.dataset");
  expect_refused("drape", {"start.protocol=lowered"}, "\"lowering\"");
  expect_refused("drape", {"start.plate_step=0"}, "start.plate_step");
  expect_refused("drape", {"start.outline=none.csv"}, "there is no file");
  expect_refused("drape",
                 {"start.protocol=ensemble", "start.ramps=0", "start.phases=0", "start.flats=0"},
                 "no start is left");
  expect_refused("branches", {"branches.softest=3", "branches.stiffest=3"},
                 "must be less than branches.stiffest");
  expect_refused("branches", {"branches.lobes=[]"}, "branches.lobes is empty");
  expect_refused("branches", {"branches.largest_step=0"}, "branches.largest_step");
  EXPECT_EQ(settings_of("branches", {"branches.lobes=[5]"}).branches.lobes, std::vector<int>{5});
}

TEST(Start, AnOutlineIsReadFromACsv) {
  const ScratchFolder scratch;
  Settings settings;
  settings.start.protocol = StartProtocol::guided;
  settings.start.outline = scratch / "outline.csv";
  const auto refused = [&](const std::string& text, const std::string& message) {
    scratch.write("outline.csv", text);
    try {
      start_profile(settings);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  };
  scratch.write("outline.csv", "x,y\n0.12,-0.12\n0.12,0.12\n-0.12,0.12\n-0.12,-0.12\n");
  const VecX profile = start_profile(settings);
  ASSERT_EQ(profile.size(), kProfileSize);
  EXPECT_NEAR(profile[0], 0.12, 1e-15);
  EXPECT_NEAR(profile[45], 0.12 * std::sqrt(2), 1e-15);
  refused("0.12,0\n", "outline.csv:1: the first line must be x,y");
  refused("x,y\n0.1,0\n0.1;0.1\n", "outline.csv:3: must be two numbers");
  refused("x,y\n0.1,0\n0,0.1\n", "three corners");
  refused("x,y\n0.12,0.12\n0.12,-0.12\n-0.12,0\n", "counter-clockwise");
  refused("x,y\n120,-120\n120,120\n-120,120\n-120,-120\n", "in metres");
  refused("x,y\n0.2,0.1\n0.3,0.1\n0.3,0.2\n", "must go round (0, 0)");
}

}  // namespace
}  // namespace drape
