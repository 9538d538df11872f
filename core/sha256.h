// SHA-256 of a file (FIPS 180-4), and the list that `sha256sum --check` reads.
//
// A table of records gets a list NAME.sha256 beside it, so that damage can be found before HDF5,
// which may crash on a damaged file, is asked to open it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace drape {

/// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);
/// Throws std::filesystem::filesystem_error if the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

/// NAME.sha256 of a file NAME.
std::filesystem::path checksum_file(const std::filesystem::path& file);
/// Writes it durably. Throws std::filesystem::filesystem_error.
void write_checksum(const std::filesystem::path& file);

enum class ChecksumState { matches, differs, missing };
/// Compares a file with the list beside it; a list that cannot be understood differs.
ChecksumState verify_checksum(const std::filesystem::path& file);

}  // namespace drape
