// Photographs of many fabrics: the program from end to end, on drawn silhouettes.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/records.h"
#include "tests/experiments/drawn_photograph.h"
#include "tests/experiments/program_fixture.h"

namespace drape {
namespace {

using PhotographSet = ProgramInFolder;

const std::string kHeader = "id,file,mm_per_pixel,areal_density_gsm,type,composition_percent\n";

TEST_F(PhotographSet, FitsEveryFabricInAFolderOfItsOwn) {
  scratch.write("five.pgm", silhouette(5));
  scratch.write("six.pgm", silhouette(6));
  scratch.write("m.csv", kHeader +
                             "a,five.pgm,2.78,200,,\nb,six.pgm,2.78,250,twills,"
                             "Cotton 98; Lycra 2\n");
  const std::string command =
      "estimate --manifest m.csv --out out --threads 1 --set mesh.vertices=300"
      " --set photograph.warp_angles=[90] --set photograph.outline_noise=6e-3"
      " --set estimate.max_restarts=0 --set estimate.max_moves=0 --set estimate.max_pops=0";
  const Ended first = drape(command);
  EXPECT_TRUE(first.exit_code == 0 || first.exit_code == 3)
      << first.text;  // a drawn drape may not exist
  EXPECT_TRUE(first.says("of 2 fabrics fitted")) << first.text;
  const std::string table = scratch.read("out/parameters.csv");
  EXPECT_TRUE(table.starts_with("id,outcome,outline_rms_mm,iou,areal_density,")) << table;
  EXPECT_NE(table.find("\na,"), std::string::npos) << table;
  EXPECT_NE(table.find("\nb,"), std::string::npos) << table;

  const Record a = read_records(scratch / "out/a/results.h5").front();
  const Record b = read_records(scratch / "out/b/results.h5").front();
  EXPECT_EQ(a.type, "");
  EXPECT_EQ(b.type, "Twill");
  EXPECT_EQ(b.composition, "Cotton 98; Spandex / Elastane 2");
  EXPECT_DOUBLE_EQ(b.fabric.areal_density, 0.25);
  EXPECT_EQ(b.observation.node_count, 6);
  const std::string config = scratch.read("out/b/config.toml");
  EXPECT_NE(config.find("prior = \"tag\""), std::string::npos) << config;
  EXPECT_TRUE(drape(command).says("Already done"));
}

TEST_F(PhotographSet, RefusesWhatCannotBeFittedBeforeItStarts) {
  scratch.write("five.pgm", silhouette(5));
  const auto expect_refused = [&](const std::string& row, const std::string& message) {
    scratch.write("m.csv", kHeader + row);
    const Ended ended = drape("estimate --manifest m.csv --out out");
    EXPECT_EQ(ended.exit_code, 2) << ended.text;
    EXPECT_TRUE(ended.says(message)) << ended.text;
    EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
  };
  expect_refused("a,none.pgm,2.78,200,,\n", "m.csv: fabric 'a': ");
  expect_refused("a,five.pgm,2.78,200,Twil,Cotton 100\n", "did you mean 'Twill'");
  expect_refused("a,five.pgm,2.78,.2,,\n", "m.csv:2: areal_density_gsm '.2'");
  expect_refused("a,five.pgm,1.39,200,,\n", "m.csv: fabric 'a': ");  // half as large: no drape
  const Ended half =
      drape("estimate --photo five.pgm --mm-per-pixel 2.78 --density .2 --type Twill --out out");
  EXPECT_EQ(half.exit_code, 2) << half.text;
  EXPECT_TRUE(half.says("--composition")) << half.text;
}

}  // namespace
}  // namespace drape
