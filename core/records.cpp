#include "core/records.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "core/durable_file.h"
#include "core/record_access.h"
#include "core/record_cells.h"

namespace drape {
namespace {

namespace fs = std::filesystem;

/// Says which record an invalid content belongs to.
template <class Action>
void in_record(size_t index, Action action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("record " + std::to_string(index) + ": " + error.what());
  }
}

/// Records in memory at a time.
constexpr size_t kBlock = 64;

/// A visitor of columns that writes rows [first, ...) of a table of `count`.
template <class Row>
struct ColumnWriter {
  const hdf5::File& file;
  size_t count, first;
  const std::vector<const Row*>& rows;
  bool create;  ///< the columns are not there yet

  template <class Place>
  void operator()(const Column& column, Place place) const {
    using Value = Stored<ValueAt<const Row, Place>>;
    using Element = typename Value::Element;
    std::vector<Element> elements;
    elements.reserve(rows.size() * size_of(column.cell));
    for (size_t i = 0; i < rows.size(); ++i)
      in_record(first + i, [&] { Value::append(std::invoke(place, *rows[i]), column, elements); });
    if (create) {
      // A reader can take the cells of single records; scalars come many at a time.
      const size_t chunk = column.cell.empty() ? std::min(count, kBlock) : 1;
      file.create<Element>(column.path, table_shape(count, column), table_shape(chunk, column));
      if (!column.unit.empty()) file.set_attribute(column.path, "units", column.unit);
    }
    file.write_rows(column.path, first, rows.size(), elements);
  }
};

/// A visitor of columns that reads rows [first, ...), as many as there are places for, of a table
/// of `count`. Columns that are younger than the file leave the rows as they are.
template <class Row>
struct ColumnReader {
  const hdf5::File& file;
  std::uint64_t version;
  size_t count, first;
  std::vector<Row>& rows;

  template <class Place>
  void operator()(const Column& column, Place place) const {
    if (column.since > version) return;
    using Value = Stored<ValueAt<Row, Place>>;
    using Element = typename Value::Element;
    const std::vector<Element> elements =
        file.dataset<Element>(column.path, table_shape(count, column))
            .template read_rows<Element>(first, rows.size());
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

/// Writes a table block by block.
class TableWriter {
 public:
  TableWriter(const hdf5::File& file, const CellSizes& sizes, size_t count)
      : file_(file), sizes_(sizes), count_(count), none_(no_estimate(sizes)) {}

  void write(size_t first, const std::vector<Record>& records) {
    std::vector<const Record*> rows;
    std::vector<const EstimateRecord*> estimates;
    std::vector<const VecX*> forces;
    bool any_estimate = false, any_contact = false;
    for (const Record& record : records) {
      in_record(first + rows.size(), [&] {
        validate(record.fabric);
        if (record.estimate && record.estimate->outcome.empty())
          throw std::invalid_argument(
              "the outcome of its estimate is empty, must be \"succeeded\" or the reason why not");
      });
      rows.push_back(&record);
      estimates.push_back(record.estimate ? &*record.estimate : &none_);
      any_estimate |= record.estimate.has_value();
      const bool in_contact = record.contact_force.size() > 0;
      forces.push_back(in_contact ? &record.contact_force : &no_force_);
      any_contact |= in_contact;
    }
    visit_record_columns(sizes_, ColumnWriter<Record>{file_, count_, first, rows, first == 0});
    // What some records have only gets its columns with the first of them. Forces not written read
    // as zero, but an estimate not made is more than zeros.
    if (any_contact || contact_) {
      visit_contact_columns(sizes_, ColumnWriter<VecX>{file_, count_, first, forces, !contact_});
      contact_ = true;
    }
    if (any_estimate || estimates_) {
      if (!estimates_)
        for (size_t earlier = 0; earlier < first; earlier += kBlock)
          write_estimates(earlier, {std::min(kBlock, first - earlier), &none_});
      write_estimates(first, estimates);
    }
  }

 private:
  void write_estimates(size_t first, const std::vector<const EstimateRecord*>& rows) {
    visit_estimate_columns(sizes_,
                           ColumnWriter<EstimateRecord>{file_, count_, first, rows, !estimates_});
    estimates_ = true;
  }

  const hdf5::File& file_;
  const CellSizes sizes_;
  const size_t count_;
  const EstimateRecord none_;
  const VecX no_force_ = VecX::Zero(static_cast<Eigen::Index>(3 * sizes_.vertices));
  bool contact_ = false, estimates_ = false;  // whether the columns are there
};

/// Records [first, first + count) of a table of `all`.
std::vector<Record> rows_of(const hdf5::File& file, size_t all, size_t first, size_t count) {
  const CellSizes sizes = cell_sizes(read_header(file));
  const std::uint64_t version = schema_version(file);
  std::vector<Record> records(count);
  visit_record_columns(sizes, ColumnReader<Record>{file, version, all, first, records});
  for (size_t i = 0; i < count; ++i) in_record(first + i, [&] { validate(records[i].fabric); });
  if (has_contact(file)) {
    std::vector<VecX> forces(count);
    visit_contact_columns(sizes, ColumnReader<VecX>{file, version, all, first, forces});
    for (size_t i = 0; i < count; ++i)
      if (records[i].stats.contact != "off") records[i].contact_force = std::move(forces[i]);
  }
  if (!has_estimates(file)) return records;

  std::vector<EstimateRecord> estimates(count);
  visit_estimate_columns(sizes, ColumnReader<EstimateRecord>{file, version, all, first, estimates});
  for (size_t i = 0; i < count; ++i)
    if (!estimates[i].outcome.empty()) records[i].estimate = std::move(estimates[i]);
  return records;
}

}  // namespace

void write_records(const fs::path& path, const RecordsHeader& header, size_t count,
                   const std::function<Record(size_t index)>& record) {
  check(header);
  naming_the_file(path, [&] {
    write_durably(path, [&](const fs::path& part) {
      std::optional<hdf5::Lock> lock(std::in_place);
      hdf5::File file = hdf5::File::create(part);
      TableWriter writer(file, cell_sizes(header), count);
      for (size_t first = 0; first == 0 || first < count; first += kBlock) {
        std::vector<Record> block;
        lock.reset();  // the record may come out of another file
        try {
          while (block.size() < kBlock && first + block.size() < count)
            block.push_back(record(first + block.size()));
        } catch (...) {
          lock.emplace();
          throw;
        }
        lock.emplace();
        writer.write(first, block);
      }
      write_header(file, header);
      file.close();
    });
  });
}

void write_records(const fs::path& path, const RecordsHeader& header,
                   const std::vector<Record>& records) {
  write_records(path, header, records.size(), [&](size_t index) { return records[index]; });
}

RecordsHeader read_header(const fs::path& path) {
  return with_records(path, [](const hdf5::File& file) { return read_header(file); });
}

size_t record_count(const fs::path& path) {
  return with_records(path, [](const hdf5::File& file) { return record_count(file); });
}

std::vector<Record> read_records(const fs::path& path, size_t first, size_t count) {
  return with_records(path, [&](const hdf5::File& file) {
    const size_t all = record_count(file);
    if (first + count > all)
      throw hdf5::Error("has " + std::to_string(all) + " records, asked for " +
                        std::to_string(first) + " to " + std::to_string(first + count - 1));
    return rows_of(file, all, first, count);
  });
}

void visit_records(const fs::path& path,
                   const std::function<void(size_t index, const Record& record)>& visit) {
  const size_t count = record_count(path);
  for (size_t first = 0; first < count; first += kBlock) {
    size_t index = first;
    for (const Record& record : read_records(path, first, std::min(kBlock, count - first)))
      visit(index++, record);
  }
}

std::vector<Record> read_records(const fs::path& path) {
  return with_records(path, [](const hdf5::File& file) {
    const size_t all = record_count(file);
    return rows_of(file, all, 0, all);
  });
}

}  // namespace drape
