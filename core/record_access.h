// Opening a file of records: the lock, and errors that name the file.
//
// Part of records.cpp.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "core/hdf5_file.h"
#include "core/record_columns.h"
#include "core/record_header.h"
#include "core/records.h"

namespace drape {

/// Runs `action`, which takes care of the lock. What HDF5 or the disk refuses names the file.
template <class Action>
auto naming_the_file(const std::filesystem::path& path, Action action) {
  try {
    return action();
  } catch (const hdf5::Error& error) {
    throw RecordError(path.string() + ": " + error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    throw RecordError(path.string() + ": " + error.what());
  }
}

/// Runs `action(file)` on a file of records, alone in HDF5; here a content out of range is the
/// file's fault too.
template <class Action>
auto with_records(const std::filesystem::path& path, Action action) {
  return naming_the_file(path, [&] {
    const hdf5::Lock lock;
    try {
      return action(open_records(path));
    } catch (const std::invalid_argument& error) {
      throw hdf5::Error(error.what());
    }
  });
}

inline size_t record_count(const hdf5::File& file) {
  return file.dataset<std::string>("/fabric/id", {hdf5::kAnySize}).shape()[0];
}

inline bool has_estimates(const hdf5::File& file) { return file.has("/estimate"); }

inline bool has_contact(const hdf5::File& file) { return file.has(kContactForce); }

}  // namespace drape
