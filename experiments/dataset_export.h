// Records in formats that others read: CSV for tables, OBJ and VTU for a drape.
#pragma once

#include <filesystem>

namespace drape {

// All throw RecordError if the records cannot be read, std::invalid_argument if `out` is there
// already or there is no such record, std::filesystem::filesystem_error if the disk refuses.

/// One line a record: tag, parameters, what is seen, how the solve went. SI units.
void export_csv(const std::filesystem::path& file, const std::filesystem::path& out);

/// Wavefront OBJ: vertices of the drape [m] and, as texture coordinates, of the flat specimen.
void export_obj(const std::filesystem::path& file, size_t record, const std::filesystem::path& out);

/// VTK's unstructured grid (XML, text) with rest positions, clamp and the support's force.
void export_vtu(const std::filesystem::path& file, size_t record, const std::filesystem::path& out);

}  // namespace drape
