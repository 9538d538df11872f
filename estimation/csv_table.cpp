#include "estimation/csv_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace drape {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (size_t end = 0; end != std::string_view::npos;) {
    end = text.find(separator);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end != std::string_view::npos) text.remove_prefix(end + 1);
  }
  return parts;
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::string in_quotes(std::string_view text) { return "'" + std::string(text) + "'"; }

std::string shown(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

double number_in_range(std::string_view column, std::string_view cell, double low, double high,
                       std::string_view unit) {
  const std::optional<double> value = number(cell);
  if (value && *value >= low && *value <= high) return *value;
  throw std::invalid_argument(std::string(column) + " " + in_quotes(cell) +
                              "; expected a number from " + shown(low) + " to " + shown(high) +
                              (unit == "1" ? "" : " " + std::string(unit)));
}

namespace {

std::string listed(const std::vector<std::string_view>& names) {
  std::string list;
  for (const std::string_view name : names) list += (list.empty() ? "" : ",") + std::string(name);
  return list;
}

}  // namespace

CsvColumns::CsvColumns(std::vector<std::string_view> known, std::vector<std::string_view> required)
    : known_(std::move(known)), required_(std::move(required)) {}

std::string CsvColumns::expected() const { return "columns out of " + listed(known_); }

void CsvColumns::take_header(std::string_view line) {
  for (const std::string_view cell : split(line, ',')) {
    if (std::find(known_.begin(), known_.end(), cell) == known_.end())
      throw std::invalid_argument("unknown column " + in_quotes(cell) + "; expected " + expected());
    if (place(cell) < names_.size())
      throw std::invalid_argument("the column " + in_quotes(cell) + " occurs twice");
    names_.emplace_back(cell);
  }
  std::vector<std::string_view> missing;
  for (const std::string_view column : required_)
    if (place(column) == names_.size()) missing.push_back(column);
  if (!missing.empty())
    throw std::invalid_argument("the header lacks " + listed(missing) + "; expected " + expected());
}

std::vector<std::string_view> CsvColumns::cells_of(std::string_view line) const {
  std::vector<std::string_view> cells = split(line, ',');
  if (cells.size() != names_.size())
    throw std::invalid_argument(std::to_string(cells.size()) + " columns; the header has " +
                                std::to_string(names_.size()));
  return cells;
}

std::optional<std::string_view> CsvColumns::cell(const std::vector<std::string_view>& cells,
                                                 std::string_view column) const {
  const size_t at = place(column);
  return at < cells.size() ? std::optional(cells[at]) : std::nullopt;
}

size_t CsvColumns::place(std::string_view column) const {
  return static_cast<size_t>(std::find(names_.begin(), names_.end(), column) - names_.begin());
}

void read_csv(const std::filesystem::path& file, const std::string& expected,
              const std::function<void(std::string_view line)>& header,
              const std::function<void(std::string_view line)>& row) {
  std::ifstream stream(file);
  if (!std::filesystem::is_regular_file(file) || !stream)
    throw std::invalid_argument(file.string() + ": no such file, or not readable; expected a " +
                                "table with " + expected);
  int rows = -1;  // the header is the first
  std::string line;
  for (int line_number = 1; std::getline(stream, line); ++line_number) {
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    try {
      (rows < 0 ? header : row)(content);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(file.string() + ":" + std::to_string(line_number) + ": " +
                                  error.what());
    }
    ++rows;
  }
  if (rows <= 0)
    throw std::invalid_argument(file.string() + ": no fabric; expected " + expected +
                                " and a line for each fabric");
}

}  // namespace drape
