#include <gtest/gtest.h>

#include <memory>

#include "experiments/config.h"
#include "experiments/config_text.h"
#include "experiments/output_folder.h"
#include "tests/experiments/scratch_folder.h"

namespace drape {
namespace {

using State = OutputFolder::State;

std::string refusal(const std::filesystem::path& folder, const Settings& settings = {}) {
  try {
    const OutputFolder output(folder, settings);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "not refused";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(OutputFolder, CreatesWithTheResolvedConfig) {
  const ScratchFolder scratch;
  Settings settings;
  settings.mesh.vertices = 321;
  const OutputFolder output(scratch / "a/b/c", settings);
  EXPECT_EQ(output.state(), State::created);
  EXPECT_EQ(scratch.read("a/b/c/config.toml"), write_settings(settings));
  EXPECT_EQ(output / "results.h5", scratch / "a/b/c/results.h5");
}

TEST(OutputFolder, TakesAnEmptyFolder) {
  const ScratchFolder scratch;
  EXPECT_EQ(OutputFolder(scratch.path(), {}).state(), State::created);
}

TEST(OutputFolder, ResumesThenLeavesAlone) {
  const ScratchFolder scratch;
  { const OutputFolder output(scratch / "run", {}); }
  scratch.write("run/record", "x");
  Settings more_threads;
  more_threads.experiment.threads = 8;
  EXPECT_EQ(OutputFolder(scratch / "run", more_threads).state(), State::resumed);
  EXPECT_EQ(scratch.read("run/config.toml"), write_settings({}));  // as first written
  scratch.write("run/summary.json", "{}");
  EXPECT_EQ(OutputFolder(scratch / "run", {}).state(), State::finished);
  EXPECT_EQ(scratch.read("run/record"), "x");
}

TEST(OutputFolder, StartCutShortCounts) {
  const ScratchFolder scratch;
  scratch.write(".drape.lock", "");
  scratch.write("config.toml.part", "[experim");
  EXPECT_EQ(OutputFolder(scratch.path(), {}).state(), State::created);
}

TEST(OutputFolder, RefusesOtherSettingsAndSaysWhich) {
  const ScratchFolder scratch;
  { const OutputFolder output(scratch / "run", {}); }
  Settings other;
  other.solver.tolerance = 1e-6;
  const std::string reason = refusal(scratch / "run", other);
  EXPECT_TRUE(contains(reason, "solver.tolerance = 1e-08, here 1e-06")) << reason;
  EXPECT_EQ(scratch.read("run/config.toml"), write_settings({}));
}

TEST(OutputFolder, RefusesOtherContentAndLeavesNothing) {
  const ScratchFolder scratch;
  scratch.write("thesis.tex", "x");
  EXPECT_TRUE(contains(refusal(scratch.path()), "has content that is no run"));
  EXPECT_TRUE(contains(refusal(scratch / "thesis.tex"), "is a file"));
  EXPECT_TRUE(contains(refusal(scratch / "thesis.tex/run"), "cannot be created"));
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(scratch.path()))
    ++files;
  EXPECT_EQ(files, 1);
  EXPECT_EQ(scratch.read("thesis.tex"), "x");
}

TEST(OutputFolder, RefusesADamagedConfig) {
  const ScratchFolder scratch;
  scratch.write("config.toml", "[\\");
  EXPECT_TRUE(contains(refusal(scratch.path()), "config.toml:1:2: "));
  EXPECT_EQ(scratch.read("config.toml"), "[\\");
}

TEST(OutputFolder, RefusesASecondProcess) {
  // flock() keeps two descriptors apart within one process as it does between processes.
  const ScratchFolder scratch;
  auto first = std::make_unique<OutputFolder>(scratch / "run", Settings{});
  EXPECT_TRUE(contains(refusal(scratch / "run"), "another process is at work"));
  first.reset();
  EXPECT_EQ(OutputFolder(scratch / "run", {}).state(), State::resumed);
}

}  // namespace
}  // namespace drape
