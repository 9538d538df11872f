// A table of records that shows those of several files without a copy (HDF5 virtual datasets).
#pragma once

#include <filesystem>
#include <vector>

#include "core/records.h"

namespace drape {

/// Writes `file`, whose rows are those of the sources in order; their mesh and scene must be those
/// of `header`. The sources are named relative to the folder of `file`: both move together. Opening
/// the table while a source is missing throws RecordError. Throws RecordError too where a source
/// cannot be read, is older than the current schema, or the disk refuses.
void write_virtual_records(const std::filesystem::path& file, const RecordsHeader& header,
                           const std::vector<std::filesystem::path>& sources);

}  // namespace drape
