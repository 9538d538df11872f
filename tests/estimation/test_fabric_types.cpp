// Tables 1 and 2 of Ju et al. 2024 (supplement), against the totals that the source prints.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "estimation/fabric_types.h"
#include "estimation/fibre_kinds.h"

namespace drape {
namespace {

TEST(FabricTypes, AreThoseOfTable1) {
  ASSERT_EQ(fabric_types().size(), 64u);
  int total = 0;
  std::map<Structure, int> of_structure;
  std::set<std::string_view> names;
  for (const FabricType& type : fabric_types()) {
    total += type.fabrics;
    of_structure[structure_from_category(type.category)] += type.fabrics;
    names.insert(type.name);
    EXPECT_EQ(find_type(type.name), &type);
    EXPECT_LT(type.light, type.heavy) << type.name;
    EXPECT_GT(type.light, 0.015) << type.name;  // [kg/m^2] tissue paper
    EXPECT_LT(type.heavy, 1) << type.name;      // carpet
  }
  EXPECT_EQ(total, kTableFabrics);
  EXPECT_EQ(of_structure[Structure::woven], 2943);
  EXPECT_EQ(of_structure[Structure::knit], 1934);
  EXPECT_EQ(of_structure[Structure::other], 268);
  EXPECT_EQ(names.size(), 64u);
  EXPECT_EQ(find_type("Jersey")->fabrics, 298);
  EXPECT_EQ(find_type("jersey"), nullptr);
}

TEST(FibreKinds, AreThoseOfTable2) {
  ASSERT_EQ(fibre_kinds().size(), 37u);
  int total = 0;
  std::set<std::string_view> names;
  for (const FibreKind& kind : fibre_kinds()) {
    total += kind.fabrics;
    names.insert(kind.name);
    EXPECT_GE(kind.modulus, 0) << kind.name;
  }
  EXPECT_EQ(total, kTableMentions);
  EXPECT_EQ(names.size(), 37u);
  EXPECT_EQ(find_fibre("Polyester")->fabrics, 3069);
  EXPECT_EQ(find_fibre(kElastane)->fabrics, 1248);
}

}  // namespace
}  // namespace drape
