// One dataset out of the shards of a run that was cut into parts.
#pragma once

#include <filesystem>
#include <vector>

namespace drape {

enum class MergeMode {
  copy,         ///< a table of its own
  virtual_view  ///< a table that shows the shards, which must stay where they are
};

/// Writes `out` and its list of check sums, with the records of all shards in the order of the set:
/// what a run without shards would have written. Returns their number. Throws
/// std::invalid_argument unless the files are the shards of one set, each once and all of them, and
/// `out` is new; RecordError if one cannot be read.
size_t merge_datasets(const std::filesystem::path& out,
                      const std::vector<std::filesystem::path>& shards, MergeMode mode);

/// Writes `out` in the current schema with the records of `file`. Returns their number. Throws
/// likewise.
size_t migrate_dataset(const std::filesystem::path& file, const std::filesystem::path& out);

}  // namespace drape
