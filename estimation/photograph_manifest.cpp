#include "estimation/photograph_manifest.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "estimation/csv_table.h"

namespace drape {
namespace {

/// The id becomes the name of a folder.
void validate_id(std::string_view id) {
  const bool plain = std::all_of(id.begin(), id.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '.';
  });
  if (id.empty() || id.front() == '.' || !plain)
    throw std::invalid_argument("id " + in_quotes(id) +
                                "; expected letters, digits, '_', '-' and '.', not '.' first");
}

class Manifest {
 public:
  explicit Manifest(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void row(std::string_view line) {
    const std::vector<std::string_view> cells = columns.cells_of(line);
    const auto text = [&](std::string_view column) {
      return columns.cell(cells, column).value_or(std::string_view());
    };
    const auto in_range = [&](std::string_view column, double low, double high,
                              std::string_view unit) {
      return number_in_range(column, text(column), low, high, unit);
    };
    PhotographedFabric read;
    read.id = text("id");
    validate_id(read.id);
    read.type = text("type");
    read.composition = text("composition_percent");
    if (read.type.empty() != read.composition.empty())
      throw std::invalid_argument("a tag has a type and a composition; give both or neither");
    read.mm_per_pixel = in_range("mm_per_pixel", 1e-3, 100, "mm");
    read.areal_density = 1e-3 * in_range("areal_density_gsm", 10, 3000, "g/m^2");
    if (!text("warp_angle_deg").empty())
      read.warp_angle_deg = in_range("warp_angle_deg", -360, 360, "degrees");
    if (!text("specimen_radius_mm").empty())
      read.specimen_radius_mm = {in_range("specimen_radius_mm", 10, 1000, "mm")};
    if (text("file").empty()) throw std::invalid_argument("no file of a picture");
    read.files = {folder_ / text("file")};
    add(std::move(read));
  }

  CsvColumns columns{{"id", "file", "mm_per_pixel", "areal_density_gsm", "specimen_radius_mm",
                      "warp_angle_deg", "type", "composition_percent"},
                     {"id", "file", "mm_per_pixel", "areal_density_gsm"}};
  std::vector<PhotographedFabric> fabrics;

 private:
  void add(PhotographedFabric read) {
    const auto known = std::find_if(fabrics.begin(), fabrics.end(),
                                    [&](const auto& fabric) { return fabric.id == read.id; });
    if (known == fabrics.end()) {
      fabrics.push_back(std::move(read));
      return;
    }
    const auto same = [&](bool agrees, const char* what) {
      if (!agrees)
        throw std::invalid_argument("fabric " + in_quotes(read.id) + " has another " + what +
                                    " than in its first line; pictures of one fabric share it");
    };
    same(known->areal_density == read.areal_density, "areal_density_gsm");
    same(known->mm_per_pixel == read.mm_per_pixel, "mm_per_pixel");
    same(known->warp_angle_deg == read.warp_angle_deg, "warp_angle_deg");
    same(known->type == read.type, "type");
    same(known->composition == read.composition, "composition_percent");
    if (known->specimen_radius_mm.empty() != read.specimen_radius_mm.empty())
      throw std::invalid_argument("fabric " + in_quotes(read.id) +
                                  ": give specimen_radius_mm in all its lines or in none");
    if (std::find(known->files.begin(), known->files.end(), read.files.front()) !=
        known->files.end())
      throw std::invalid_argument(in_quotes(read.files.front().string()) +
                                  " occurs twice for fabric " + in_quotes(read.id));
    known->files.push_back(read.files.front());
    if (!read.specimen_radius_mm.empty())
      known->specimen_radius_mm.push_back(read.specimen_radius_mm.front());
  }

  std::filesystem::path folder_;
};

}  // namespace

std::vector<PhotographedFabric> read_photograph_manifest(const std::filesystem::path& file) {
  Manifest manifest(file.parent_path());
  read_csv(
      file, manifest.columns.expected(),
      [&](std::string_view line) { manifest.columns.take_header(line); },
      [&](std::string_view line) { manifest.row(line); });
  return std::move(manifest.fabrics);
}

}  // namespace drape
