// The 64 types of fabric of Table 1 of Ju et al. 2024 (supplement), with how many of its 5145
// fabrics are of each, and what cloth of that type weighs.
#pragma once

#include <span>
#include <string_view>

#include "estimation/tag.h"

namespace drape {

struct FabricType {
  std::string_view category, subcategory, name;  ///< the names differ from each other
  int fabrics;                                   ///< of the 5145 of Table 1
  double light, heavy;  ///< a tenth of the fabrics lies below, a tenth above [kg/m^2]
};

/// In the order of Table 1.
std::span<const FabricType> fabric_types();

/// nullptr if no type has exactly this name.
const FabricType* find_type(std::string_view name);

/// All fabrics of Table 1.
inline constexpr int kTableFabrics = 5145;

}  // namespace drape
