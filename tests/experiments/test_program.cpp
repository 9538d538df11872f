// The program as a user meets it: exit codes, messages, and what it leaves on the disk.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/hdf5_file.h"
#include "tests/experiments/program_fixture.h"

namespace drape {
namespace {

using GreyOf = bool (*)(int column, int row);

bool in_disc(int column, int row, int centre_column, int centre_row, int radius) {
  const int x = column - centre_column, y = row - centre_row;
  return x * x + y * y <= radius * radius;
}

/// A binary PGM of 128 x 128 pixels, white where `white` holds.
std::string drawn(GreyOf white) {
  std::string image = "P5\n128 128\n255\n";
  for (int row = 0; row < 128; ++row)
    for (int column = 0; column < 128; ++column) image += white(column, row) ? '\xff' : '\0';
  return image;
}

/// A disc of 45 pixels radius whose grey falls from white to black over 16 pixels.
std::string blurred_disc() {
  std::string image = "P5\n128 128\n255\n";
  for (int row = 0; row < 128; ++row)
    for (int column = 0; column < 128; ++column) {
      const double depth = 45 - std::hypot(column - 64, row - 64);
      image += static_cast<char>(std::lround(255 * std::clamp(0.5 + depth / 16, 0.0, 1.0)));
    }
  return image;
}

class Program : public ProgramInFolder {
 protected:
  // Exit code 2, a message with this text, and no output folder.
  void expect_refused(const std::string& arguments, const std::string& message) const {
    const Ended ended = drape(arguments);
    EXPECT_EQ(ended.exit_code, 2) << arguments << "\n" << ended.text;
    EXPECT_TRUE(ended.says(message)) << arguments << "\n" << ended.text;
    EXPECT_FALSE(std::filesystem::exists(scratch / "out")) << arguments;
  }

  // The same, where the message is a single line.
  void expect_refused_in_a_line(const std::string& arguments, const std::string& message) const {
    expect_refused(arguments, message);
    const std::string text = drape(arguments).text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  }

  void SetUp() override {
    scratch.write("a.toml",
                  "[experiment]\nkind = 'drape'\n[mesh]\nvertices = 250\nclamp_refinement = 1\n"
                  "[fabric]\nk_bu = 2e-5\nk_bv = 2e-5\nk_bh = 2e-5\n");
  }
};

TEST_F(Program, HelpAndVersion) {
  EXPECT_EQ(drape("--help").exit_code, 0);
  EXPECT_TRUE(drape("--version").says("drape "));
  for (const char* command : {"run", "validate", "explain", "info", "estimate", "dataset", "tag"}) {
    const Ended ended = drape(std::string(command) + " --help");
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_TRUE(ended.says(std::string("drape ") + command)) << ended.text;
  }
}

TEST_F(Program, Explain) {
  EXPECT_TRUE(drape("explain").says("[solver]"));
  EXPECT_EQ(drape("explain solver.tolerance").exit_code, 0);
  expect_refused("explain solver.tolerence", "did you mean 'tolerance'?");
}

TEST_F(Program, Validate) {
  const Ended valid = drape("validate a.toml");
  EXPECT_EQ(valid.exit_code, 0);
  EXPECT_TRUE(valid.says("a.toml: valid")) << valid.text;
  scratch.write("b.toml", "[experiment]\nkind = 'drape'\n[solver]\ntolerence = 1e-8\n");
  expect_refused("validate b.toml",
                 "b.toml:4:1: unknown key 'solver.tolerence'; did you mean 'tolerance'?");
}

TEST_F(Program, WrongUse) {
  expect_refused("", "required");
  expect_refused("rum a.toml --out out", "unknown command 'rum'; did you mean 'run'?");
  expect_refused("run a.toml --out out --thread 2", "'--thread'; did you mean '--threads'?");
  expect_refused("run a.toml", "--out is required");
  expect_refused("run --out out", "CONFIG is required");
  expect_refused("run a.toml b.toml --out out", "b.toml");
  expect_refused("run a.toml --out out --threads two", "--threads two: ");
  expect_refused("run a.toml --out out --set mesh.vertces=300", "did you mean 'vertices'?");
  expect_refused("run a.toml --out out --set mesh.vertices", "section.key=value");
  expect_refused("info none.h5", "none.h5");
}

TEST_F(Program, BadConfig) {
  expect_refused("run none.toml --out out", "none.toml: no such file");
  expect_refused("run . --out out", "is a folder");
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"", "is empty"},
           {"[\\", "b.toml:1:2: "},
           {"[mesh]\nseed = 1\nseed = 2\n", "b.toml:3:"},
           {"[fabric]\nk_bu = -1\n", "b.toml:2:8: fabric.k_bu = -1: must be a finite number > 0"},
           {"[fabric]\nareal_density = 0\n", "b.toml:2:17: "},
           {"[fabric]\nk_u = inf\n", "b.toml:2:7: "},
           {"[mesh]\nseed = 1\n", "experiment.kind is missing"}}) {
    scratch.write("b.toml", text);
    expect_refused("run b.toml --out out", message);
  }
}

TEST_F(Program, EstimateNeedsItsInput) {
  expect_refused("estimate --out out",
                 "needs --photo FILE, --manifest FILE, --dataset FILE or a CONFIG");
  expect_refused("estimate a.toml --out out", "not \"drape\"");
  expect_refused("estimate --photo none.png --mm-per-pixel 1.39 --density .2 --out out",
                 "--photo: photograph.files: there is no file");
  expect_refused("estimate --photo a.toml --density .2 --out out", "mm_per_pixel");
  expect_refused("estimate --photo a.toml --mm-per-pixel 1.39 --out out", "areal_density");
  expect_refused("estimate --photo a.toml --mm-per-pixel -1 --density .2 --out out",
                 "--mm-per-pixel -1: ");
  expect_refused("estimate --dataset none.h5 --records 0,1 --out out", "there is no file");
  expect_refused("estimate --dataset a.toml --records 0,x --out out", "--records [0, x]: ");
  expect_refused("estimate --mm-per-pixel 1 --out out", "--photo");
  expect_refused("estimate --warp-angle 90 --out out", "--photo");
  const std::string photos = "estimate --mm-per-pixel 1.39 --density .2 --out out --photo a.toml ";
  expect_refused(photos + "none.png", "--photo: photograph.files: there is no file");
  expect_refused(photos + "a.toml", "has \"");
  expect_refused(photos + "--warp-angle up", "--warp-angle [up]: ");
  expect_refused(photos + "--specimen-radius-mm 150 120",
                 "--specimen-radius-mm: photograph.specimen_radius_mm holds 2 radii for 1 files");
  expect_refused(photos + "--specimen-radius-mm 80", "--specimen-radius-mm: ");
  expect_refused(photos + "--specimen-radius-mm wide", "--specimen-radius-mm");
  expect_refused(photos + "--camera-height-mm 140", "--camera-height-mm 140: ");
  expect_refused("estimate --photo a.toml --mm-per-pixel 1.39 --density 180 --out out",
                 "--density 180: photograph.areal_density = 180 kg/m^2: no cloth is that heavy; if "
                 "it is in g/m^2, write 0.18");
}

TEST_F(Program, BadParameters) {
  for (const char* value : {"-2e-6", "0", "nan", "inf", "-inf"}) {
    scratch.write("b.toml",
                  "[experiment]\nkind = 'drape'\n[fabric]\nk_bu = " + std::string(value) + "\n");
    expect_refused_in_a_line("run b.toml --out out", "b.toml:4:8: fabric.k_bu = ");
    expect_refused_in_a_line(
        "run a.toml --out out --set fabric.areal_density=" + std::string(value),
        "must be a finite number > 0 kg/m^2");
  }
  expect_refused_in_a_line("run a.toml --out out --set fabric.t_bu=1.01", "fabric.t_bu = 1.01");
  expect_refused_in_a_line("run a.toml --out out --set fabric.k_w=1",
                           "unknown key 'fabric.k_w'; did you mean 'k_");
}

TEST_F(Program, ImagesThatAreNoSilhouette) {
  // 128 pixels of 2.78 mm: a drape has a radius between 33 and 53 of them
  const std::vector<std::tuple<std::string, std::string, std::string>> images{
      {"uniform.pgm", drawn([](int, int) { return false; }), "the image is uniform"},
      {"two.pgm",
       drawn([](int c, int r) { return in_disc(c, r, 35, 64, 25) || in_disc(c, r, 93, 64, 25); }),
       "several blobs"},
      {"border.pgm", drawn([](int c, int r) { return in_disc(c, r, 30, 64, 45); }),
       "touches the image's border"},
      {"hole.pgm",
       drawn([](int c, int r) { return in_disc(c, r, 64, 64, 45) && !in_disc(c, r, 64, 64, 9); }),
       "has a hole"},
      {"blurred.pgm", blurred_disc(), "the image is blurred"},
      {"small.pgm", drawn([](int c, int r) { return in_disc(c, r, 64, 64, 25); }),
       "a drape lies between its support"},
      {"text.png", "not an image", "not an image"},
      {"empty.png", "", "the file is empty"}};
  for (const auto& [name, content, message] : images) {
    scratch.write(name, content);
    expect_refused_in_a_line(
        "estimate --photo " + name + " --mm-per-pixel 2.78 --density .2 --out out", message);
    EXPECT_EQ(scratch.read(name), content);
  }
}

TEST_F(Program, FilesThatAreNoRecords) {
  {
    const hdf5::Lock lock;
    hdf5::File file = hdf5::File::create(scratch / "other.h5");
    file.set_attribute<std::string>("/", "schema", "somebody-elses");
    file.write<double>("/table", {3}, {3}, {1, 2, 3});
    file.close();
  }
  scratch.write("damaged.h5", "\x89HDF\r\n\x1a\n");
  for (const std::string name : {"other.h5", "damaged.h5", "a.toml"}) {
    const std::string before = scratch.read(name);
    expect_refused_in_a_line("info " + name, name);
    expect_refused_in_a_line("estimate --dataset " + name + " --records 0 --out out", name);
    EXPECT_EQ(scratch.read(name), before);
  }
  EXPECT_TRUE(drape("info other.h5").says("drape-records"));
}

TEST_F(Program, RunsOnceAndThenLeavesTheFolderAlone) {
  const Ended first = drape("run a.toml --out out --threads 1");
  ASSERT_EQ(first.exit_code, 0) << first.text;
  const auto summary = nlohmann::json::parse(scratch.read("out/summary.json"));
  EXPECT_EQ(summary["kind"], "drape");
  EXPECT_EQ(summary["status"], "ok");
  const auto written = std::filesystem::last_write_time(scratch / "out/summary.json");

  const Ended second = drape("run a.toml --out out");
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_TRUE(second.says("Already done")) << second.text;
  // The resolved config describes the same run.
  EXPECT_TRUE(drape("run out/config.toml --out out").says("Already done"));

  const Ended other = drape("run a.toml --out out --set mesh.seed=2");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(other.says("mesh.seed = 1, here 2")) << other.text;
  EXPECT_EQ(std::filesystem::last_write_time(scratch / "out/summary.json"), written);
}

TEST_F(Program, ContactIsDecidedAndReported) {
  const auto draped = [&](const std::string& out, const std::string& settings) {
    const Ended ended =
        drape("run a.toml --threads 1 --set start.protocol=lobes --out " + out + " " + settings);
    EXPECT_EQ(ended.exit_code, 0) << ended.text;
    return nlohmann::json::parse(scratch.read(out + "/summary.json"));
  };
  const auto stiff = draped("stiff", "");
  EXPECT_EQ(stiff["contact"], "off");
  EXPECT_EQ(stiff["contact_checked"], true);
  EXPECT_EQ(stiff["self_intersections"], 0);
  EXPECT_EQ(stiff["support_penetration_mm"], 0);

  const std::string soft = "--set fabric.k_bu=4e-7 --set fabric.k_bv=3e-7 --set fabric.k_bh=3.5e-7";
  const auto automatic = draped("automatic", soft);
  EXPECT_EQ(automatic["contact"], "support");
  EXPECT_LT(automatic["support_penetration_mm"], 0.3);
  EXPECT_NE(automatic["contact_reason"].get<std::string>().find("without it"), std::string::npos);
  EXPECT_TRUE(drape("info automatic/results.h5").says("/sim/contact_force"));
  const auto off = draped("off", soft + " --set scene.contact=off");
  EXPECT_EQ(off["contact"], "off");
  EXPECT_GT(off["support_penetration_mm"], 1);
  // nothing in the way of the folds
  const auto slim = draped("slim", soft + " --set scene.column_radius=0.03");
  EXPECT_EQ(slim["contact"], "off");
  EXPECT_EQ(slim["support_penetration_mm"], 0);
  EXPECT_EQ(slim["drape_coefficient_percent"], off["drape_coefficient_percent"]);
}

TEST_F(Program, RefusesAFolderWithOtherContent) {
  std::filesystem::create_directory(scratch / "full");
  scratch.write("full/thesis.tex", "x");
  const Ended ended = drape("run a.toml --out full");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_TRUE(ended.says("has content that is no run")) << ended.text;
  EXPECT_FALSE(std::filesystem::exists(scratch / "full/config.toml"));
  EXPECT_EQ(scratch.read("full/thesis.tex"), "x");
}

TEST_F(Program, RefusesAFileAsTheFolder) {
  scratch.write("full", "x");
  const Ended ended = drape("run a.toml --out full");
  EXPECT_EQ(ended.exit_code, 2) << ended.text;
  EXPECT_EQ(scratch.read("full"), "x");
}

TEST_F(Program, FailedSolveIsExitCode3) {
  const std::string command = "run a.toml --out out --set solver.max_iterations=1";
  const Ended ended = drape(command);
  EXPECT_EQ(ended.exit_code, 3) << ended.text;
  EXPECT_EQ(nlohmann::json::parse(scratch.read("out/summary.json"))["status"], "failed");
  EXPECT_EQ(drape(command).exit_code, 3);  // already done, with the same outcome
}

TEST_F(Program, AFailedFabricIsReplayedByTheCommandThatTheSummaryNames) {
  scratch.write("r.toml",
                "[experiment]\nkind = 'robustness'\n[robustness]\nfabrics = 4\nvertices = [250]\n"
                "[start]\nprotocol = 'lobes'\n[solver]\nmax_iterations = 1\n");
  const Ended ended = drape("run r.toml --out out --threads 1");
  ASSERT_EQ(ended.exit_code, 3) << ended.text;
  const auto summary = nlohmann::json::parse(scratch.read("out/summary.json"));
  EXPECT_EQ(summary["fabrics"], 4);
  EXPECT_EQ(summary["distributions"]["measured"]["fabrics"], 2);
  EXPECT_EQ(summary["failure_classes"]["iteration_limit"], 4);
  for (const char* file : {"out/results.h5", "out/solves.csv", "out/units.png"})
    EXPECT_TRUE(std::filesystem::exists(scratch / file)) << file;

  const auto& failure = summary["failures"][3];
  std::string replay = failure["replay"];
  ASSERT_EQ(replay.rfind("drape ", 0), 0u) << replay;
  const Ended again = drape(replay.substr(6));
  EXPECT_EQ(again.exit_code, 3) << again.text;
  const auto one = nlohmann::json::parse(scratch.read("out/replay_250_3/summary.json"));
  ASSERT_EQ(one["failures"].size(), 1u);
  for (const char* key : {"index", "seed", "distribution", "vertices", "class", "residual"})
    EXPECT_EQ(one["failures"][0][key], failure[key]) << key;
}

TEST_F(Program, InterruptedIsExitCode130AndResumable) {
  const std::string command = DRAPE_PROGRAM
      " run a.toml --out out --set experiment.kind=dataset --set dataset.fabrics=3000";
  for (int session = 0; session < 2; ++session) {
    const Ended ended = shell("timeout --preserve-status --signal=INT 2 " + command);
    EXPECT_EQ(ended.exit_code, 130) << ended.text;
    EXPECT_TRUE(ended.says("the same command resumes it")) << ended.text;
    EXPECT_EQ(ended.says("Resuming"), session == 1) << ended.text;
    EXPECT_FALSE(std::filesystem::exists(scratch / "out/summary.json"));
  }
}

}  // namespace
}  // namespace drape
