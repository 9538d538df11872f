// Reads which photographs show which fabric, from a table.
//
// Columns, in any order:
//   id                   of the fabric; lines of one id are pictures of one fabric, fitted together
//   file                 of the picture; relative to the table's folder
//   mm_per_pixel         in the plane of the drape
//   areal_density_gsm    g/m^2
//   specimen_radius_mm   may be missing, or empty in every line of a fabric
//   warp_angle_deg       of the warp, counter-clockwise from the right; likewise: not known
//   type, composition_percent    of the tag, as people write them; likewise
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace drape {

struct PhotographedFabric {
  std::string id;
  std::string type, composition;  ///< empty: not known
  double areal_density = 0;       ///< [kg/m^2]
  double mm_per_pixel = 0;        ///< [mm]
  std::optional<double> warp_angle_deg;
  std::vector<std::filesystem::path> files;
  std::vector<double> specimen_radius_mm;  ///< one a file, or empty

  bool has_tag() const { return !type.empty(); }
};

/// In the order of their first lines. Throws std::invalid_argument beginning with FILE:LINE that
/// says what is wrong and what is right: missing and unknown columns, values that are no numbers or
/// out of range, an id that cannot name a folder, lines of one fabric that contradict each other.
std::vector<PhotographedFabric> read_photograph_manifest(const std::filesystem::path& file);

}  // namespace drape
