// Reads fabrics with all their parameters from a table in the units of the garment software that
// the parameters of Ju et al. 2024 come from: gram, millimetre, second.
//
// Columns, in any order; the names are the software's own (CLO, Marvelous Designer):
//   id; category, subcategory, type, composition_percent (may be missing, or empty)
//   density                                  g/m^2
//   fSuK, fSvK (stretch, weft and warp), fHK (shear)          g/s^2      1e-3 N/m
//   fBuK, fBvK, fBhK (bending, weft, warp, bias)              g mm^2/s^2 1e-9 N m
//   fBucklingStiffnessU, ...V, ...H (s_b); fBuLR, fBvLR, fBhLR (buckling ratio, t_b)
// The last six may be missing: .8 and .3 then. The ratio becomes t_b as it is, which fits the
// reading "radius" (0: never past the threshold, 1: at once).
#pragma once

#include <filesystem>
#include <vector>

#include "core/fabric.h"
#include "estimation/tag.h"

namespace drape {

/// Texts of a tag are empty where the table has none. Throws std::invalid_argument beginning with
/// FILE:LINE that says what is wrong and what is right: missing and unknown columns, values outside
/// of the software's ranges (mostly a matter of units), categories and compositions as in a table
/// of tags, an id that occurs twice.
std::vector<TaggedFabric> read_fabric_table(const std::filesystem::path& file);

}  // namespace drape
