#include "core/records.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <type_traits>

#include "core/durable_file.h"
#include "core/hdf5_file.h"
#include "core/record_columns.h"
#include "core/record_header.h"

namespace drape {
namespace {

namespace fs = std::filesystem;

constexpr double kFullCoverage = std::numeric_limits<std::uint16_t>::max();

/// Runs `action` alone in HDF5. What the library or the disk refuses names the file.
template <class Action>
auto with_hdf5(const fs::path& path, Action action) {
  const hdf5::Lock lock;
  try {
    return action();
  } catch (const hdf5::Error& error) {
    throw RecordError(path.string() + ": " + error.what());
  } catch (const fs::filesystem_error& error) {
    throw RecordError(path.string() + ": " + error.what());
  }
}

/// Runs `action(file)` on a file of records; here a content out of range is the file's fault too.
template <class Action>
auto with_records(const fs::path& path, Action action) {
  return with_hdf5(path, [&] {
    try {
      return action(open_records(path));
    } catch (const std::invalid_argument& error) {
      throw hdf5::Error(error.what());
    }
  });
}

/// Says which record an invalid content belongs to.
template <class Action>
void in_record(size_t index, Action action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("record " + std::to_string(index) + ": " + error.what());
  }
}

// How a value of a record lies on disk: the type of its elements, and the way there and back.

/// A number or a text: one element.
template <class Value>
struct Stored {
  using Element = std::conditional_t<std::is_same_v<Value, bool>, std::uint8_t, Value>;
  static void append(const Value& value, const Column&, std::vector<Element>& elements) {
    elements.push_back(static_cast<Element>(value));
  }
  static void take(const Element* element, const hdf5::Shape&, Value& value) {
    value = static_cast<Value>(*element);
  }
};

hsize_t size_of(const hdf5::Shape& cell) {
  return std::accumulate(cell.begin(), cell.end(), hsize_t{1}, std::multiplies<>());
}

template <>
struct Stored<VecX> {
  using Element = double;
  static void append(const VecX& value, const Column& column, std::vector<double>& elements) {
    if (static_cast<hsize_t>(value.size()) != size_of(column.cell))
      throw std::invalid_argument(column.path + " has " + std::to_string(value.size()) +
                                  " values, must have " + std::to_string(size_of(column.cell)));
    elements.insert(elements.end(), value.begin(), value.end());
  }
  static void take(const double* elements, const hdf5::Shape& cell, VecX& value) {
    value = Eigen::Map<const VecX>(elements, static_cast<Eigen::Index>(size_of(cell)));
  }
};

template <>
struct Stored<CoverageImage> {
  using Element = std::uint16_t;
  static void append(const CoverageImage& value, const Column& column,
                     std::vector<Element>& elements) {
    const hdf5::Shape shape{static_cast<hsize_t>(value.rows()), static_cast<hsize_t>(value.cols())};
    if (shape != column.cell)
      throw std::invalid_argument(column.path + " is " + hdf5::to_string(shape) +
                                  ", must be as the grid, " + hdf5::to_string(column.cell));
    for (const double share : value.reshaped<Eigen::RowMajor>()) {
      if (!(share >= 0 && share <= 1))
        throw std::invalid_argument(column.path + " holds " + std::to_string(share) +
                                    ", must be within [0, 1]");
      elements.push_back(static_cast<Element>(std::lround(share * kFullCoverage)));
    }
  }
  static void take(const Element* elements, const hdf5::Shape& cell, CoverageImage& value) {
    using Image = Eigen::Matrix<Element, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    value = Eigen::Map<const Image>(elements, static_cast<Eigen::Index>(cell[0]),
                                    static_cast<Eigen::Index>(cell[1]))
                .cast<double>() /
            kFullCoverage;
  }
};

template <class Row, class Place>
using ValueAt = std::remove_cvref_t<std::invoke_result_t<Place, Row&>>;

hdf5::Shape table_shape(size_t count, const Column& column) {
  hdf5::Shape shape{count};
  shape.insert(shape.end(), column.cell.begin(), column.cell.end());
  return shape;
}

/// A visitor of columns that writes them.
template <class Row>
struct ColumnWriter {
  const hdf5::File& file;
  const std::vector<const Row*>& rows;

  template <class Place>
  void operator()(const Column& column, Place place) const {
    using Value = Stored<ValueAt<const Row, Place>>;
    std::vector<typename Value::Element> elements;
    elements.reserve(rows.size() * size_of(column.cell));
    for (size_t i = 0; i < rows.size(); ++i)
      in_record(i, [&] { Value::append(std::invoke(place, *rows[i]), column, elements); });
    // A reader can take the cells of single records; scalars come as a whole.
    file.write(column.path, table_shape(rows.size(), column),
               table_shape(column.cell.empty() ? rows.size() : 1, column), elements);
    if (!column.unit.empty()) file.set_attribute(column.path, "units", column.unit);
  }
};

/// A visitor of columns that reads them into as many rows as there are. Columns that are younger
/// than the file leave the rows as they are.
template <class Row>
struct ColumnReader {
  const hdf5::File& file;
  std::vector<Row>& rows;

  template <class Place>
  void operator()(const Column& column, Place place) const {
    if (column.since > schema_version(file)) return;
    using Value = Stored<ValueAt<Row, Place>>;
    using Element = typename Value::Element;
    const std::vector<Element> elements =
        file.dataset<Element>(column.path, table_shape(rows.size(), column))
            .template read<Element>();
    for (size_t i = 0; i < rows.size(); ++i)
      Value::take(&elements[i * size_of(column.cell)], column.cell, std::invoke(place, rows[i]));
  }
};

CellSizes cell_sizes(const RecordsHeader& header) {
  return {static_cast<hsize_t>(header.rest_uv.rows()), static_cast<hsize_t>(header.grid.rows),
          static_cast<hsize_t>(header.grid.columns)};
}

/// Stands in the table for the estimate of a record that has none: NaN and an empty outcome.
EstimateRecord no_estimate(const CellSizes& sizes) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EstimateRecord estimate;
  visit_estimate_columns(sizes, [&](const Column& column, auto place) {
    auto& value = std::invoke(place, estimate);
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, VecX>)
      value = VecX::Constant(static_cast<Eigen::Index>(size_of(column.cell)), kNaN);
    else if constexpr (std::is_same_v<Value, double>)
      value = kNaN;
    else
      value = Value{};
  });
  return estimate;
}

size_t record_count(const hdf5::File& file) {
  return file.dataset<std::string>("/fabric/id", {hdf5::kAnySize}).shape()[0];
}

bool has_estimates(const hdf5::File& file) { return file.has_group("/estimate"); }

bool has_contact(const hdf5::File& file) {
  const std::vector<std::string> paths = file.datasets();
  return std::find(paths.begin(), paths.end(), kContactForce) != paths.end();
}

// The parts of describe_records.

/// "14 of 15 (93.3 %)": how many rows of a column hold `wanted`.
std::string share_of(const hdf5::File& file, const std::string& path, const std::string& wanted) {
  const std::vector<std::string> values = file.dataset(path).read<std::string>();
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

/// Smallest and largest number of a column, read row by row, and how many rows hold a NaN.
std::string describe_numbers(const hdf5::Dataset& data) {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  hsize_t rows_with_nan = 0;
  const hsize_t count = data.shape().at(0);
  for (hsize_t row = 0; row < count; ++row) {
    bool has_nan = false;
    for (const double value : data.read_rows<double>(row, 1)) {
      has_nan |= std::isnan(value);
      least = std::fmin(least, value);
      greatest = std::fmax(greatest, value);
    }
    rows_with_nan += has_nan;
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

void write_records(const fs::path& path, const RecordsHeader& header,
                   const std::vector<Record>& records) {
  check(header);
  const CellSizes sizes = cell_sizes(header);
  const EstimateRecord none = no_estimate(sizes);
  std::vector<const Record*> rows;
  std::vector<const EstimateRecord*> estimates;
  bool any_estimate = false, any_contact = false;
  const VecX no_force = VecX::Zero(static_cast<Eigen::Index>(3 * sizes.vertices));
  std::vector<const VecX*> forces;
  for (const Record& record : records) {
    in_record(rows.size(), [&] {
      validate(record.fabric);
      if (record.estimate && record.estimate->outcome.empty())
        throw std::invalid_argument(
            "the outcome of its estimate is empty, must be \"succeeded\" or the reason why not");
    });
    rows.push_back(&record);
    estimates.push_back(record.estimate ? &*record.estimate : &none);
    any_estimate |= record.estimate.has_value();
    const bool in_contact = record.contact_force.size() > 0;
    forces.push_back(in_contact ? &record.contact_force : &no_force);
    any_contact |= in_contact;
  }
  with_hdf5(path, [&] {
    write_durably(path, [&](const fs::path& part) {
      hdf5::File file = hdf5::File::create(part);
      visit_record_columns(sizes, ColumnWriter<Record>{file, rows});
      if (any_contact) visit_contact_columns(sizes, ColumnWriter<VecX>{file, forces});
      if (any_estimate)
        visit_estimate_columns(sizes, ColumnWriter<EstimateRecord>{file, estimates});
      write_header(file, header);
      file.close();
    });
  });
}

RecordsHeader read_header(const fs::path& path) {
  return with_records(path, [](const hdf5::File& file) { return read_header(file); });
}

std::vector<Record> read_records(const fs::path& path) {
  return with_records(path, [](const hdf5::File& file) {
    const CellSizes sizes = cell_sizes(read_header(file));
    std::vector<Record> records(record_count(file));
    visit_record_columns(sizes, ColumnReader<Record>{file, records});
    for (size_t i = 0; i < records.size(); ++i) in_record(i, [&] { validate(records[i].fabric); });
    if (has_contact(file)) {
      std::vector<VecX> forces(records.size());
      visit_contact_columns(sizes, ColumnReader<VecX>{file, forces});
      for (size_t i = 0; i < records.size(); ++i)
        if (records[i].stats.contact != "off") records[i].contact_force = std::move(forces[i]);
    }
    if (!has_estimates(file)) return records;

    std::vector<EstimateRecord> estimates(records.size());
    visit_estimate_columns(sizes, ColumnReader<EstimateRecord>{file, estimates});
    for (size_t i = 0; i < records.size(); ++i)
      if (!estimates[i].outcome.empty()) records[i].estimate = std::move(estimates[i]);
    return records;
  });
}

std::string describe_records(const fs::path& path) {
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
