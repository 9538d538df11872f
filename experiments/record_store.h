// The finished records of a run: one durable file each while it is at work, one table at the end.
//
// records/NNNNNN.h5 appears when record N is complete and on disk, so a killed run resumes with
// what it had acknowledged. results.h5 is written from these files once all are there.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/records.h"

namespace drape {

/// Safe to use from several threads, one thread an index; consolidate() from one thread alone.
class RecordStore {
 public:
  /// Takes up what the folder holds of `count` records.
  RecordStore(const std::filesystem::path& folder, RecordsHeader header, int count);

  int count() const { return count_; }
  /// Whether the record was finished, in this session or before.
  bool has(int index) const;
  /// Number of finished records.
  int finished() const;
  /// On return the record is on disk. Throws RecordError.
  void save(int index, const Record& record) const;
  /// Throws RecordError if it is not there.
  Record load(int index) const;
  /// Calls visit(record) for all in order, some in memory at a time. Throws RecordError if one is
  /// missing.
  void visit(const std::function<void(const Record&)>& visit) const;
  /// All records in order. Throws RecordError if one is missing.
  std::vector<Record> load_all() const;
  /// Writes results.h5 and removes the files it replaces. Throws RecordError if a record is
  /// missing.
  void consolidate() const;

 private:
  std::filesystem::path file(int index) const;

  std::filesystem::path table_, records_;
  RecordsHeader header_;
  int count_;
};

}  // namespace drape
