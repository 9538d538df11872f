// The 37 fibres of Table 2 of Ju et al. 2024 (supplement), with how many of its 5145 fabrics
// contain each (8879 mentions), how often a fibre is the main one, and how stiff it is.
#pragma once

#include <span>
#include <string_view>

namespace drape {

struct FibreKind {
  std::string_view name;
  int fabrics;        ///< of the 5145 that contain it
  double main_share;  ///< of these, in which no other fibre has a larger part (relative weight)
  double modulus;     ///< initial tensile modulus [GPa]; 0: none found
};

/// In the order of Table 2.
std::span<const FibreKind> fibre_kinds();

/// nullptr if no fibre has exactly this name.
const FibreKind* find_fibre(std::string_view name);

/// All mentions of Table 2.
inline constexpr int kTableMentions = 8879;

inline constexpr std::string_view kElastane = "Spandex / Elastane";

}  // namespace drape
