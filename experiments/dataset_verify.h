// Is a table of records what it claims to be?
#pragma once

#include <filesystem>
#include <string>

namespace drape {

/// Compares the file with its list of check sums, before anything else touches it. Returns what was
/// found as a line; throws RecordError if the sums differ or the file cannot be read.
std::string verify_bytes(const std::filesystem::path& file);

/// Reads everything and checks schema, ranges and what depends on each other; recomputes residual
/// and outline of up to `sample` drapes, spread over the table, from their positions. Returns what
/// was looked at as some lines; throws RecordError that names record and reason.
std::string verify_records(const std::filesystem::path& file, int sample);

}  // namespace drape
