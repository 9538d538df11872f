// Virtual datasets: one dataset that shows the rows of several files one after the other.
//
// Nothing is copied: the files must stay where they are, relative to the file that shows them. HDF5
// reads rows of a missing file as zeros without a word, so File::dataset() asks check_sources().
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/hdf5_file.h"

namespace drape::hdf5 {

/// A file and how many rows it brings.
struct RowSource {
  std::filesystem::path file;  ///< as the virtual dataset will name it
  hsize_t rows;
  bool has_column;  ///< false: rows of zeros take the place of the column
};

/// Makes the dataset `path` of `target`, of the type and the cells of `like` and with the rows of
/// the sources in order.
void create_virtual(const File& target, const Dataset& like, const std::string& path,
                    const std::vector<RowSource>& sources);

/// Throws Error if `data`, of a file in `folder`, shows rows of files that are not there.
void check_sources(const Dataset& data, const std::filesystem::path& folder);

}  // namespace drape::hdf5
