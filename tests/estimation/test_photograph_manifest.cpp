#include <gtest/gtest.h>

#include "estimation/photograph_manifest.h"
#include "tests/support/table_file.h"

namespace drape {
namespace {

using PhotographManifest = test::TableFile<read_photograph_manifest>;

const std::string kHeader = "id,file,mm_per_pixel,areal_density_gsm\n";

TEST_F(PhotographManifest, GathersThePicturesOfAFabric) {
  write(
      "# specimens of two sizes\nfile,id,areal_density_gsm,mm_per_pixel,specimen_radius_mm,type,"
      "composition_percent,warp_angle_deg\n"
      "a.png,five,274,1.39,150,Twill,Cotton 98; Elastane 2,90\n"
      "c.png,other-1,80,1.2,,,,\n"
      "sub/b.png,five,274,1.39,120,Twill,Cotton 98; Elastane 2,90\n");
  const std::vector<PhotographedFabric> fabrics = read_photograph_manifest(file_);
  ASSERT_EQ(fabrics.size(), 2u);
  const PhotographedFabric& five = fabrics[0];
  EXPECT_EQ(five.id, "five");
  EXPECT_EQ(five.type, "Twill");
  EXPECT_EQ(five.composition, "Cotton 98; Elastane 2");
  EXPECT_TRUE(five.has_tag());
  EXPECT_DOUBLE_EQ(five.areal_density, 0.274);
  EXPECT_DOUBLE_EQ(five.mm_per_pixel, 1.39);
  EXPECT_EQ(five.warp_angle_deg, 90);
  ASSERT_EQ(five.files.size(), 2u);
  EXPECT_EQ(five.files[1], file_.parent_path() / "sub/b.png");
  EXPECT_EQ(five.specimen_radius_mm, (std::vector<double>{150, 120}));
  EXPECT_FALSE(fabrics[1].has_tag());
  EXPECT_FALSE(fabrics[1].warp_angle_deg);
  EXPECT_TRUE(fabrics[1].specimen_radius_mm.empty());
}

TEST_F(PhotographManifest, SaysWhatIsWrongAndWhere) {
  expect_refused("id,file,mm_per_pixel\n", ":1: the header lacks areal_density_gsm");
  expect_refused("id,files,mm_per_pixel,areal_density_gsm\n", ":1: unknown column 'files'");
  expect_refused("id,id,file,mm_per_pixel,areal_density_gsm\n", ":1: the column 'id' occurs");
  expect_refused(kHeader + "a,a.png,1.39\n", ":2: 3 columns; the header has 4");
  expect_refused(kHeader + "../a,a.png,1.39,200\n", ":2: id '../a'; expected letters");
  expect_refused(kHeader + ",a.png,1.39,200\n", ":2: id ''");
  expect_refused(kHeader + "a,,1.39,200\n", ":2: no file");
  expect_refused(kHeader + "a,a.png,0,200\n", ":2: mm_per_pixel '0'; expected a number");
  expect_refused(kHeader + "a,a.png,1.39,0.2\n", ":2: areal_density_gsm '0.2'; expected");
  expect_refused(kHeader + "a,a.png,1.39,200\na,b.png,1.39,201\n",
                 ":3: fabric 'a' has another areal_density_gsm");
  expect_refused(kHeader + "a,a.png,1.39,200\na,a.png,1.39,200\n", ":3: '");
  expect_refused("type," + kHeader + "Twill,a,a.png,1.39,200\n", ":2: a tag has a type and");
  expect_refused("specimen_radius_mm," + kHeader + "150,a,a.png,1.39,200\n,a,b.png,1.39,200\n",
                 ":3: fabric 'a': give specimen_radius_mm in all");
  expect_refused(kHeader, ": no fabric");
}

}  // namespace
}  // namespace drape
