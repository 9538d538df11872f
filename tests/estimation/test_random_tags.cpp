// The numbers of Tables 1 and 2 come out exactly, and in proportion for fewer fabrics.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "estimation/fabric_types.h"
#include "estimation/fibre_kinds.h"
#include "estimation/random_tags.h"

namespace drape {
namespace {

struct Counts {
  std::map<std::string, int> types, fibres;
  explicit Counts(const std::vector<Tag>& tags) {
    for (const Tag& tag : tags) {
      ++types[tag.type];
      for (const Fibre& fibre : tag.composition) ++fibres[fibre.name];
    }
  }
};

TEST(Apportion, IsByLargestRemainder) {
  const std::vector<double> weights{47000, 16000, 15800, 12000, 6100, 3100};
  EXPECT_EQ(apportion(10, weights), (std::vector<int>{5, 2, 1, 1, 1, 0}));
  const std::vector<int> limits{3, 9, 9, 9, 9, 0};
  const std::vector<int> limited = apportion(10, weights, limits);
  EXPECT_EQ(limited[0], 3);
  EXPECT_EQ(limited[5], 0);
  EXPECT_EQ(std::accumulate(limited.begin(), limited.end(), 0), 10);
  EXPECT_THROW(apportion(40, weights, limits), std::invalid_argument);
  EXPECT_EQ(apportion(0, weights), (std::vector<int>(6, 0)));
}

TEST(RandomTags, OfTheFullSetReproduceBothTablesExactly) {
  for (const std::uint64_t seed : {1u, 2u}) {
    Counts counts(random_tags(kTableFabrics, seed));
    for (const FabricType& type : fabric_types())
      EXPECT_EQ(counts.types[std::string(type.name)], type.fabrics) << type.name;
    for (const FibreKind& kind : fibre_kinds())
      EXPECT_EQ(counts.fibres[std::string(kind.name)], kind.fabrics) << kind.name;
  }
}

TEST(RandomTags, OfFewerFabricsAreInProportion) {
  for (const int count : {1, 2, 3, 12, 64, 500}) {
    const std::vector<Tag> tags = random_tags(count, 3);
    ASSERT_EQ(tags.size(), static_cast<size_t>(count));
    Counts counts(tags);
    const double share = static_cast<double>(count) / kTableFabrics;
    for (const FabricType& type : fabric_types())
      EXPECT_LT(std::abs(counts.types[std::string(type.name)] - share * type.fabrics), 1);
    for (const FibreKind& kind : fibre_kinds())  // within one, and half a mention of the total
      EXPECT_LT(std::abs(counts.fibres[std::string(kind.name)] - share * kind.fabrics), 1.5);
  }
}

TEST(RandomTags, AreTagsThatTheReaderAccepts) {
  const std::vector<Tag> tags = random_tags(kTableFabrics, 5);
  std::set<std::string> ids;
  int outside = 0;
  for (const Tag& tag : tags) {
    ids.insert(tag.id);
    const FabricType* type = find_type(tag.type);
    ASSERT_NE(type, nullptr) << tag.type;
    EXPECT_EQ(tag.category, type->category);
    EXPECT_EQ(tag.subcategory, type->subcategory);
    outside += tag.areal_density < type->light || tag.areal_density > type->heavy;
    std::string text;
    double sum = 0;
    for (const Fibre& fibre : tag.composition) {
      EXPECT_NE(find_fibre(fibre.name), nullptr) << fibre.name;
      EXPECT_EQ(fibre.percent, std::round(fibre.percent));
      sum += fibre.percent;
      text += (text.empty() ? "" : "; ") + fibre.name + " " +
              std::to_string(static_cast<int>(fibre.percent));
    }
    EXPECT_EQ(sum, 100) << text;
    EXPECT_EQ(composition_from_text(text).size(), tag.composition.size());
  }
  EXPECT_EQ(ids.size(), tags.size());
  EXPECT_NEAR(outside / 5145.0, 0.2, 0.03);  // a tenth on each side, +-.006 by chance, and rounding
}

TEST(RandomTags, GoTogetherAsInAShop) {
  const std::vector<Tag> tags = random_tags(kTableFabrics, 7);
  const auto share = [&](const std::string& type, const std::string& fibre) {
    double with = 0, all = 0;
    for (const Tag& tag : tags)
      if (tag.type == type) {
        ++all;
        for (const Fibre& of : tag.composition) with += of.name == fibre;
      }
    return with / all;
  };
  EXPECT_GT(share("Denim", "Cotton"), 0.8);
  EXPECT_GT(share("Tyvek", "PE"), 0.8);
  EXPECT_LT(share("Dewspo", "Cotton"), 0.1);
  EXPECT_GT(share("Melton / Boiled", "Wool"), 0.5);
  EXPECT_GT(share("Ponte", std::string(kElastane)), share("Chiffon", std::string(kElastane)));
}

TEST(RandomTags, DependOnTheSeedAlone) {
  const auto densities = [](std::uint64_t seed) {
    std::vector<double> values;
    for (const Tag& tag : random_tags(50, seed)) values.push_back(tag.areal_density);
    return values;
  };
  EXPECT_EQ(densities(1), densities(1));
  EXPECT_NE(densities(1), densities(2));
}

}  // namespace
}  // namespace drape
