#include <gtest/gtest.h>

#include "estimation/fabric_import.h"
#include "tests/support/table_file.h"

namespace drape {
namespace {

using FabricImport = test::TableFile<read_fabric_table>;

const std::string kHeader = "id,density,fSuK,fSvK,fHK,fBuK,fBvK,fBhK\n";

TEST_F(FabricImport, ConvertsToSi) {
  write(
      "# from a garment program\nfBuLR,id,type,category,composition_percent,density,fSuK,fSvK,fHK,"
      "fBuK,fBvK,fBhK,fBucklingStiffnessV\n"
      ".25,a 1,Twill,Woven,Linen 29; Polyester 71,168,100000,200000,10000,2000,3000,1500,.5\n"
      "0,b,,,,55,1000,1000,1000,.5,1,2,1\n");
  const std::vector<TaggedFabric> fabrics = read_fabric_table(file_);
  ASSERT_EQ(fabrics.size(), 2u);
  const auto& [tag, fabric] = fabrics[0];
  EXPECT_EQ(tag.id, "a 1");
  EXPECT_EQ(tag.type, "Twill");
  EXPECT_EQ(tag.composition.size(), 2u);
  EXPECT_DOUBLE_EQ(tag.areal_density, 0.168);
  EXPECT_DOUBLE_EQ(fabric.areal_density, 0.168);
  EXPECT_DOUBLE_EQ(fabric.k_u, 100);
  EXPECT_DOUBLE_EQ(fabric.k_v, 200);
  EXPECT_DOUBLE_EQ(fabric.k_h, 10);
  EXPECT_DOUBLE_EQ(fabric.k_bu, 2e-6);
  EXPECT_DOUBLE_EQ(fabric.k_bv, 3e-6);
  EXPECT_DOUBLE_EQ(fabric.k_bh, 1.5e-6);
  EXPECT_EQ(fabric.s_bu, 0.8);
  EXPECT_EQ(fabric.s_bv, 0.5);
  EXPECT_EQ(fabric.t_bu, 0.25);
  EXPECT_EQ(fabric.t_bv, 0.3);
  EXPECT_EQ(fabrics[1].tag.category, "");
  validate(fabrics[1].fabric);
}

TEST_F(FabricImport, SaysWhatIsWrongAndWhere) {
  const std::string row = "a,168,1e5,1e5,1e4,2000,2000,2000\n";
  expect_refused("id,density,fSuK\n", ":1: the header lacks fSvK,fHK,fBuK,fBvK,fBhK");
  expect_refused("id,id\n", ":1: the column 'id' occurs twice");
  expect_refused("id,gsm\n", ":1: unknown column 'gsm'");
  expect_refused(kHeader, ": no fabric");
  expect_refused(kHeader + "a,168\n", ":2: 2 columns; the header has 8");
  expect_refused(kHeader + row + "b,.168,1e5,1e5,1e4,2000,2000,2000\n",
                 ":3: density '.168'; expected a number from 10 to 3000 g/m^2");
  expect_refused(kHeader + "b,168,100,1e5,1e4,2000,2000,2000\n",
                 ":2: fSuK '100'; expected a number from 1000 to 1e+07 g/s^2");
  expect_refused(kHeader + "b,168,1e5,1e5,1e4,2e-6,2000,2000\n", ":2: fBuK '2e-6'");
  expect_refused(kHeader + "b,168,1e5,1e5,1e4,x,2000,2000\n", ":2: fBuK 'x'");
  expect_refused(kHeader + "b,168,1e5,1e5,nan,2000,2000,2000\n", ":2: fHK 'nan'");
  expect_refused(kHeader + row + row, ":3: id 'a' occurs twice");
  expect_refused(kHeader + ",168,1e5,1e5,1e4,2000,2000,2000\n", ":2: empty id");
  expect_refused("composition_percent," + kHeader + "Wool 30," + row, ":2: composition 'Wool 30'");
  std::filesystem::remove(file_);
  EXPECT_THROW(read_fabric_table(file_), std::invalid_argument);
}

}  // namespace
}  // namespace drape
