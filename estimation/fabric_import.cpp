#include "estimation/fabric_import.h"

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>

#include "estimation/csv_table.h"

namespace drape {
namespace {

struct ImportColumn {
  std::string_view name;
  Parameter parameter;
  std::string_view unit;
  double si_factor;
  double low, high;  ///< in the table's unit; for the stiffnesses what the software lets one set
  bool required;
};

constexpr double kSmallest = 1e-3;  // where the software allows zero, which no Fabric does

constexpr std::array kColumns = std::to_array<ImportColumn>({
    {"density", Parameter::areal_density, "g/m^2", 1e-3, 10, 3000, true},
    {"fSuK", Parameter::k_u, "g/s^2", 1e-3, 1e3, 1e7, true},
    {"fSvK", Parameter::k_v, "g/s^2", 1e-3, 1e3, 1e7, true},
    {"fHK", Parameter::k_h, "g/s^2", 1e-3, 1e3, 1e7, true},
    {"fBuK", Parameter::k_bu, "g mm^2/s^2", 1e-9, kSmallest, 2e6, true},
    {"fBvK", Parameter::k_bv, "g mm^2/s^2", 1e-9, kSmallest, 2e6, true},
    {"fBhK", Parameter::k_bh, "g mm^2/s^2", 1e-9, kSmallest, 2e6, true},
    {"fBucklingStiffnessU", Parameter::s_bu, "1", 1, kSmallest, 1, false},
    {"fBucklingStiffnessV", Parameter::s_bv, "1", 1, kSmallest, 1, false},
    {"fBucklingStiffnessH", Parameter::s_bh, "1", 1, kSmallest, 1, false},
    {"fBuLR", Parameter::t_bu, "1", 1, 0, 1, false},
    {"fBvLR", Parameter::t_bv, "1", 1, 0, 1, false},
    {"fBhLR", Parameter::t_bh, "1", 1, 0, 1, false},
});
constexpr std::array<std::string_view, 5> kTexts{"id", "category", "subcategory", "type",
                                                 "composition_percent"};

std::string listed(std::string list, std::string_view name) {
  return (list.empty() ? "" : list + ",") + std::string(name);
}

std::string expected_header() {
  std::string names;
  for (const std::string_view text : kTexts) names = listed(names, text);
  for (const ImportColumn& column : kColumns) names = listed(names, column.name);
  return "columns out of " + names;
}

class Importer {
 public:
  void header(std::string_view line) {
    for (const std::string_view cell : split(line, ',')) {
      const bool known = std::find(kTexts.begin(), kTexts.end(), cell) != kTexts.end() ||
                         std::any_of(kColumns.begin(), kColumns.end(),
                                     [cell](const ImportColumn& c) { return c.name == cell; });
      if (!known)
        throw std::invalid_argument("unknown column " + in_quotes(cell) + "; expected " +
                                    expected_header());
      if (place(cell) < names_.size())
        throw std::invalid_argument("the column " + in_quotes(cell) + " occurs twice");
      names_.emplace_back(cell);
    }
    std::string missing;
    if (place("id") == names_.size()) missing = "id";
    for (const ImportColumn& column : kColumns)
      if (column.required && place(column.name) == names_.size())
        missing = listed(missing, column.name);
    if (!missing.empty())
      throw std::invalid_argument("the header lacks " + missing + "; expected " +
                                  expected_header());
  }

  void row(std::string_view line) {
    const std::vector<std::string_view> cells = split(line, ',');
    if (cells.size() != names_.size())
      throw std::invalid_argument(std::to_string(cells.size()) + " columns; the header has " +
                                  std::to_string(names_.size()));
    const auto text = [&](std::string_view name) {
      const size_t at = place(name);
      return at < cells.size() ? std::string(cells[at]) : std::string();
    };
    TaggedFabric imported;
    Tag& tag = imported.tag;
    tag.id = text("id");
    tag.category = text("category");
    tag.subcategory = text("subcategory");
    tag.type = text("type");
    if (tag.id.empty()) throw std::invalid_argument("empty id; every fabric needs its own");
    if (!ids_.insert(tag.id).second)
      throw std::invalid_argument("id " + in_quotes(tag.id) + " occurs twice; ids must differ");
    if (!tag.category.empty()) structure_from_category(tag.category);
    if (const std::string fibres = text("composition_percent"); !fibres.empty())
      tag.composition = composition_from_text(fibres);

    for (Parameter p : {Parameter::s_bu, Parameter::s_bv, Parameter::s_bh})
      imported.fabric[p] = 0.8;
    for (const ImportColumn& column : kColumns) {
      const size_t at = place(column.name);
      if (at < cells.size())
        imported.fabric[column.parameter] = column.si_factor * checked(column, cells[at]);
    }
    tag.areal_density = imported.fabric.areal_density;
    fabrics.push_back(std::move(imported));
  }

  std::vector<TaggedFabric> fabrics;

 private:
  /// names_.size() if there is none.
  size_t place(std::string_view name) const {
    return static_cast<size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
  }

  static double checked(const ImportColumn& column, std::string_view cell) {
    const std::optional<double> value = number(cell);
    if (value && *value >= column.low && *value <= column.high) return *value;
    throw std::invalid_argument(std::string(column.name) + " " + in_quotes(cell) +
                                "; expected a number from " + shown(column.low) + " to " +
                                shown(column.high) +
                                (column.unit == "1" ? "" : " " + std::string(column.unit)));
  }

  std::vector<std::string> names_;
  std::set<std::string> ids_;
};

}  // namespace

std::vector<TaggedFabric> read_fabric_table(const std::filesystem::path& file) {
  Importer importer;
  read_csv(
      file, expected_header(), [&](std::string_view line) { importer.header(line); },
      [&](std::string_view line) { importer.row(line); });
  return std::move(importer.fabrics);
}

}  // namespace drape
