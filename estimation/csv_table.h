// Small tables as text: comma-separated, without quotes; lines that start with '#' and empty lines
// are skipped, and the first other line is the header. Errors begin with FILE:LINE.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

std::string_view trimmed(std::string_view text);
/// The trimmed parts between separators.
std::vector<std::string_view> split(std::string_view text, char separator);
/// The whole text as a finite number.
std::optional<double> number(std::string_view text);
std::string in_quotes(std::string_view text);
/// The shortest text of a number, 99 rather than 99.000000.
std::string shown(double value);

/// Calls `header` with the first line and `row` with each further one. A std::invalid_argument that
/// they throw is thrown again with FILE:LINE in front. Throws std::invalid_argument that ends with
/// `expected` where the file cannot be read or has no row.
void read_csv(const std::filesystem::path& file, const std::string& expected,
              const std::function<void(std::string_view line)>& header,
              const std::function<void(std::string_view line)>& row);

}  // namespace drape
