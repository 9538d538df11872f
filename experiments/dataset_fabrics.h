// The fabrics that a dataset asks for: with tags of the model, of a table, imported with their
// parameters, or at random without tags.
#pragma once

#include <vector>

#include "core/records.h"
#include "estimation/tag.h"
#include "experiments/settings.h"

namespace drape {

/// The record of a fabric with its tag, no drape yet.
Record tagged(const Tag& tag, const Fabric& fabric);
/// The other way round. Throws like composition_from_text; a composition may be missing.
Tag tag_of(const Record& record);
/// Name and tag of one record become those of another.
void copy_tag(const Record& from, Record& to);

class DatasetFabrics {
 public:
  /// Reads the table if there is one; throws like read_tag_table and read_fabric_table.
  explicit DatasetFabrics(const Settings& settings);

  /// Of the whole set, whatever the shard.
  int count() const { return count_; }
  /// Those that this run drapes: of its shard, or dataset.only. Throws std::invalid_argument if
  /// that names a fabric that is not there.
  std::vector<int> chosen() const;
  /// Tag and parameters, no drape yet. Depends on index and seed alone.
  Record operator[](int index) const;
  std::uint64_t seed(int index) const;

 private:
  const Settings& settings_;
  std::vector<Record> listed_;  ///< of a table
  std::vector<Tag> tags_;       ///< of the model
  int count_;
};

}  // namespace drape
