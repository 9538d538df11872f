#include "core/virtual_records.h"

#include <algorithm>
#include <map>
#include <optional>

#include "core/durable_file.h"
#include "core/hdf5_virtual.h"
#include "core/record_access.h"

namespace drape {
namespace {

namespace fs = std::filesystem;

/// What one source brings.
struct Source {
  fs::path name;
  hsize_t rows;
  std::vector<std::string> columns;
};

bool is_column(const std::string& path) { return !path.starts_with("/mesh/"); }

Source inspect(const fs::path& path, const fs::path& folder) {
  return with_records(path, [&](const hdf5::File& file) {
    if (schema_version(file) != kSchemaVersion)
      throw hdf5::Error("has version " + std::to_string(schema_version(file)) + " of " + kSchema +
                        "; bring it up to version " + std::to_string(kSchemaVersion) +
                        " with drape dataset migrate");
    if (has_estimates(file)) throw hdf5::Error("holds estimates; only drapes can be shown");
    return Source{fs::proximate(fs::absolute(path), folder), record_count(file), file.datasets()};
  });
}

}  // namespace

void write_virtual_records(const fs::path& path, const RecordsHeader& header,
                           const std::vector<fs::path>& paths) {
  check(header);
  const fs::path folder = fs::absolute(path).parent_path();
  std::vector<Source> sources;
  std::map<std::string, fs::path> columns;  // with a file that has it
  for (const fs::path& source : paths) {
    sources.push_back(inspect(source, folder));
    for (const std::string& column : sources.back().columns)
      if (is_column(column)) columns.emplace(column, source);
  }
  naming_the_file(path, [&] {
    write_durably(path, [&](const fs::path& part) {
      const hdf5::Lock lock;
      hdf5::File file = hdf5::File::create(part);
      for (const auto& [column, example] : columns) {
        const hdf5::File model = hdf5::File::open(example);
        std::vector<hdf5::RowSource> rows;
        for (const Source& s : sources)
          rows.push_back(
              {s.name, s.rows,
               std::find(s.columns.begin(), s.columns.end(), column) != s.columns.end()});
        hdf5::create_virtual(file, model.dataset(column), column, rows);
        if (model.has_attribute(column, "units"))
          file.set_attribute(column, "units", model.attribute<std::string>(column, "units"));
      }
      write_header(file, header);
      file.close();
    });
  });
}

}  // namespace drape
