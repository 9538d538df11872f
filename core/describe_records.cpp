#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

#include "core/record_access.h"
#include "core/record_cells.h"

namespace drape {
namespace {

/// "14 of 15 (93.3 %)": how many rows of a column hold `wanted`.
std::string share_of(const hdf5::File& file, const std::string& path, const std::string& wanted) {
  const auto values = file.dataset<std::string>(path, {hdf5::kAnySize}).read<std::string>();
  const auto found = std::count(values.begin(), values.end(), wanted);
  std::ostringstream text;
  text << found << " of " << values.size();
  if (!values.empty())
    text << std::setprecision(3) << " ("
         << 100. * static_cast<double>(found) / static_cast<double>(values.size()) << " %)";
  return text.str();
}

/// The few different texts of a column with their counts, or how many different ones there are.
std::string describe_texts(const hdf5::Dataset& data) {
  constexpr size_t kListed = 4;
  std::map<std::string, int> counts;
  for (const std::string& value : data.read<std::string>()) ++counts[value];
  std::ostringstream text;
  if (counts.size() > kListed) {
    text << counts.size() << " different, \"" << counts.begin()->first << "\" to \""
         << counts.rbegin()->first << "\"";
  } else {
    for (const auto& [value, count] : counts)
      text << (text.tellp() > 0 ? ", " : "") << '"' << value << "\" x " << count;
  }
  return text.str();
}

/// Numbers in memory at a time.
constexpr hsize_t kBlock = 4096;

/// Smallest and largest number of a column and how many rows hold a NaN.
std::string describe_numbers(const hdf5::Dataset& data) {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  hsize_t rows_with_nan = 0;
  hdf5::Shape cell = data.shape();
  const hsize_t count = std::exchange(cell.at(0), 1);
  const hsize_t size = std::max<hsize_t>(1, size_of(cell));
  const hsize_t block = std::max<hsize_t>(1, kBlock / size);
  for (hsize_t first = 0; first < count; first += block) {
    const auto values = data.read_rows<double>(first, std::min(block, count - first));
    for (auto row = values.begin(); row != values.end(); row += static_cast<std::ptrdiff_t>(size)) {
      bool has_nan = false;
      for (hsize_t i = 0; i < size; ++i) {
        const double value = row[static_cast<std::ptrdiff_t>(i)];
        has_nan |= std::isnan(value);
        least = std::fmin(least, value);
        greatest = std::fmax(greatest, value);
      }
      rows_with_nan += has_nan;
    }
  }
  std::ostringstream text;
  if (least <= greatest) text << least << " .. " << greatest;
  if (rows_with_nan > 0)
    text << (least <= greatest ? ", " : "") << "NaN in " << rows_with_nan << " rows";
  return text.str();
}

/// One line: path, type, shape, range, unit.
std::string describe_column(const hdf5::File& file, const std::string& path) {
  const hdf5::Dataset data = file.dataset(path);
  const std::string type = data.type_name();
  std::ostringstream text;
  text << "  " << std::left << std::setw(42) << path << std::setw(5) << type << std::setw(16)
       << hdf5::to_string(data.shape());
  const bool has_rows = !data.shape().empty();
  if (has_rows && type == hdf5::type_name<std::string>())
    text << describe_texts(data);
  else if (has_rows && data.is_number())
    text << describe_numbers(data);
  if (file.has_attribute(path, "units")) {
    const auto units = file.attribute<std::string>(path, "units");
    if (units != "1") text << " " << units;
  }
  text << "\n";
  return text.str();
}

}  // namespace

std::string describe_records(const std::filesystem::path& path) {
  return with_records(path, [&path](const hdf5::File& file) {
    const RecordsHeader header = read_header(file);
    const size_t count = record_count(file);
    std::ostringstream text;
    text << path.filename().string() << ": " << count << " records\n"
         << "schema       " << kSchema << " " << schema_version(file) << ", seed " << header.seed
         << ", commit " << header.git_commit << ", " << header.compiler << "\n"
         << "mesh         " << header.mesh_id << ": " << header.rest_uv.rows() << " vertices, "
         << header.triangles.rows() << " triangles, "
         << std::count(header.fixed.begin(), header.fixed.end(), 1)
         << " fixed vertices, clamp_wing_factor " << header.clamp_wing_factor << "\n"
         << "scene        specimen " << header.scene.specimen_radius << " m, support "
         << header.scene.support_radius << " m, gravity " << header.scene.gravity << " m/s^2\n"
         << "bending      law " << name(header.reading.law) << ", threshold "
         << name(header.reading.threshold) << "\n";
    text << "converged    " << share_of(file, "/stats/status", "converged") << "\n";
    if (has_estimates(file))
      text << "estimates    " << share_of(file, "/estimate/outcome", "succeeded") << " succeeded\n";
    text << "columns\n";
    for (const std::string& column : file.datasets()) text << describe_column(file, column);
    return text.str();
  });
}

}  // namespace drape
