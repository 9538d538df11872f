#include "estimation/tag_features.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "estimation/csv_table.h"
#include "estimation/fabric_types.h"
#include "estimation/fibre_kinds.h"

namespace drape {
namespace {

constexpr double kReferenceWeight = 0.2;  // [kg/m^2], where the slopes by structure meet

using Pair = std::pair<std::string_view, std::string_view>;

/// Category and subcategory, in the order of the table of types.
const std::vector<Pair>& subcategories() {
  static const std::vector<Pair> list = [] {
    std::vector<Pair> pairs;
    for (const FabricType& type : fabric_types()) {
      const Pair pair{type.category, type.subcategory};
      if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
    }
    return pairs;
  }();
  return list;
}

const std::vector<std::string_view>& categories() {
  static const std::vector<std::string_view> list = [] {
    std::vector<std::string_view> names;
    for (const Pair& pair : subcategories())
      if (std::find(names.begin(), names.end(), pair.first) == names.end())
        names.push_back(pair.first);
    return names;
  }();
  return list;
}

void validate_words(const Tag& tag) {
  structure_from_category(tag.category);
  std::string_view subcategory = tag.subcategory;
  if (!tag.type.empty()) {
    const FabricType* type = find_type(tag.type);
    if (type == nullptr) throw std::invalid_argument("unknown type " + in_quotes(tag.type));
    if (subcategory.empty()) subcategory = type->subcategory;
    if (type->category != tag.category || type->subcategory != subcategory)
      throw std::invalid_argument("type " + in_quotes(tag.type) + " is of " +
                                  in_quotes(type->category) + ", " + in_quotes(type->subcategory) +
                                  ", not of " + in_quotes(tag.category) + ", " +
                                  in_quotes(subcategory));
  }
  const std::vector<Pair>& known = subcategories();
  if (!subcategory.empty() &&
      std::find(known.begin(), known.end(), Pair{tag.category, subcategory}) == known.end())
    throw std::invalid_argument("unknown subcategory " + in_quotes(subcategory) + " of " +
                                in_quotes(tag.category));
  for (const Fibre& fibre : tag.composition)
    if (find_fibre(fibre.name) == nullptr)
      throw std::invalid_argument("unknown fibre " + in_quotes(fibre.name));
  if (!std::isfinite(tag.areal_density) || tag.areal_density <= 0)
    throw std::invalid_argument("areal density " + shown(tag.areal_density) +
                                " kg/m^2; must be positive and finite");
}

}  // namespace

VecX tag_features(const Tag& tag) {
  validate_words(tag);
  const FabricType* type = find_type(tag.type);
  const std::string_view subcategory = type != nullptr ? type->subcategory : tag.subcategory;
  const double log_weight = std::log(tag.areal_density / kReferenceWeight);
  const bool elastane = std::any_of(tag.composition.begin(), tag.composition.end(),
                                    [](const Fibre& fibre) { return fibre.name == kElastane; });
  std::vector<double> x{log_weight, elastane ? 1. : 0.};
  for (const Structure structure : {Structure::woven, Structure::knit, Structure::other}) {
    const bool here = structure_from_category(tag.category) == structure;
    x.push_back(here ? log_weight : 0);
    x.push_back(here && elastane ? 1 : 0);
  }
  for (const std::string_view category : categories()) x.push_back(category == tag.category);
  for (const Pair& pair : subcategories()) x.push_back(pair == Pair{tag.category, subcategory});
  for (const FabricType& other : fabric_types()) x.push_back(&other == type);
  for (const FibreKind& kind : fibre_kinds()) {
    double percent = 0;
    for (const Fibre& fibre : tag.composition)
      if (fibre.name == kind.name) percent += fibre.percent;
    x.push_back(percent / 100);
  }
  return Eigen::Map<const VecX>(x.data(), static_cast<Eigen::Index>(x.size()));
}

}  // namespace drape
