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

/// The cell as a number; otherwise throws std::invalid_argument that names the column, the limits
/// and their unit ("1" for none).
double number_in_range(std::string_view column, std::string_view cell, double low, double high,
                       std::string_view unit);

/// The columns of a table that may stand in any order. Errors are std::invalid_argument.
class CsvColumns {
 public:
  CsvColumns(std::vector<std::string_view> known, std::vector<std::string_view> required);

  /// "columns out of " and all that are known.
  std::string expected() const;
  /// Throws on columns that are unknown, occur twice or are missing though required.
  void take_header(std::string_view line);
  /// Throws where a line has not one cell a column of the header.
  std::vector<std::string_view> cells_of(std::string_view line) const;
  /// Nothing where the header lacks the column.
  std::optional<std::string_view> cell(const std::vector<std::string_view>& cells,
                                       std::string_view column) const;

 private:
  /// Of the header; names_.size() if there is none.
  size_t place(std::string_view column) const;

  std::vector<std::string_view> known_, required_;
  std::vector<std::string> names_;
};

/// Calls `header` with the first line and `row` with each further one. A std::invalid_argument that
/// they throw is thrown again with FILE:LINE in front. Throws std::invalid_argument that ends with
/// `expected` where the file cannot be read or has no row.
void read_csv(const std::filesystem::path& file, const std::string& expected,
              const std::function<void(std::string_view line)>& header,
              const std::function<void(std::string_view line)>& row);

}  // namespace drape
