// The tag of a fabric (what a supplier prints on it) and first parameters guessed from it.
//
// Categories, types and fibres follow Tables 1 and 2 of Ju et al. 2024 (supplement). The rule of
// first_parameters is a start for an estimation, not a prediction: the measured rigidity of fabrics
// of one weight scatters by a factor exp(0.82) = 2.3 (one standard deviation).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/fabric.h"

namespace drape {

struct Fibre {
  std::string name;
  double percent;  ///< of the mass
};

struct Tag {
  std::string id;
  std::string category, subcategory, type;
  std::vector<Fibre> composition;
  double areal_density = 0;  ///< [kg/m^2]
};

struct TaggedFabric {
  Tag tag;
  Fabric fabric;
};

/// How the cloth is made, as far as first_parameters needs it.
enum class Structure { woven, knit, other };

/// "Woven" -> woven, "Cut & Sew knit" -> knit, "Animal alternatives" and "Non-fabric" -> other.
/// Throws std::invalid_argument that lists the known categories.
Structure structure_from_category(std::string_view category);

/// Parses "Linen 29; Polyester 68; Spandex / Elastane 3": name and percent of every fibre. Throws
/// std::invalid_argument unless every percent is in (0, 100], no fibre occurs twice and the sum is
/// 100 within rounding (half a percent a fibre, at least one: sources print 88 + 11).
std::vector<Fibre> composition_from_text(std::string_view text);

/// The other way round: "Linen 29; Polyester 68; Spandex / Elastane 3".
std::string composition_text(const std::vector<Fibre>& composition);

/// Reads a table of tags: comma-separated, without quotes; lines that start with '#' and empty
/// lines are skipped; the first other line is the header
/// id,category,subcategory,type,composition_percent,areal_density_gsm (density in g/m^2 here only).
/// Throws std::invalid_argument beginning with FILE:LINE that says what is wrong and what is right.
std::vector<Tag> read_tag_table(const std::filesystem::path& file);

/// First parameters from structure and weight alone [kg/m^2]; see below.
Fabric first_parameters(Structure structure, double areal_density);

/// First parameters from weight, structure and elastane; every number is commented at its place.
/// Throws std::invalid_argument for an unknown category or a density that is not positive and
/// finite.
Fabric first_parameters(const Tag& tag);

}  // namespace drape
