// The header of a file of records on disk: schema, provenance, scene, mesh and pixel grid.
//
// Part of records.cpp; hold an hdf5::Lock. Attributes of "/" are in SI units (gravity in m/s^2,
// radii in m).
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/hdf5_file.h"
#include "core/records.h"

namespace drape {

inline constexpr const char* kSchema = "drape-records";
inline constexpr std::uint64_t kSchemaVersion = 3;

/// Throws std::invalid_argument that names what is out of range.
void check(const RecordsHeader& header);

/// Opens a file for reading. Throws hdf5::Error unless it is of the schema that this program writes
/// and of its version or an older one.
hdf5::File open_records(const std::filesystem::path& path);

/// Version 1 knows no contact: neither its columns nor a column radius; version 2 no shares of the
/// pictures in an estimate, no placement and no effective rigidity.
std::uint64_t schema_version(const hdf5::File& file);

/// /sim and /observation/coverage, which carry attributes of the header, must have been written.
void write_header(const hdf5::File& file, const RecordsHeader& header);

/// Throws hdf5::Error if something is missing or of another type, std::invalid_argument if it is
/// out of range.
RecordsHeader read_header(const hdf5::File& file);

}  // namespace drape
