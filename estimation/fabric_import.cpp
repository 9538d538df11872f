#include "estimation/fabric_import.h"

#include <array>
#include <set>
#include <stdexcept>
#include <utility>

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
CsvColumns columns_of_table() {
  std::vector<std::string_view> known{"id", "category", "subcategory", "type",
                                      "composition_percent"};
  std::vector<std::string_view> required{"id"};
  for (const ImportColumn& column : kColumns) {
    known.push_back(column.name);
    if (column.required) required.push_back(column.name);
  }
  return {std::move(known), std::move(required)};
}

class Importer {
 public:
  void row(std::string_view line) {
    const std::vector<std::string_view> cells = columns.cells_of(line);
    const auto text = [&](std::string_view column) {
      return std::string(columns.cell(cells, column).value_or(std::string_view()));
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
    for (const ImportColumn& column : kColumns)
      if (const auto cell = columns.cell(cells, column.name))
        imported.fabric[column.parameter] =
            column.si_factor *
            number_in_range(column.name, *cell, column.low, column.high, column.unit);
    tag.areal_density = imported.fabric.areal_density;
    fabrics.push_back(std::move(imported));
  }

  CsvColumns columns = columns_of_table();
  std::vector<TaggedFabric> fabrics;

 private:
  std::set<std::string> ids_;
};

}  // namespace

std::vector<TaggedFabric> read_fabric_table(const std::filesystem::path& file) {
  Importer importer;
  read_csv(
      file, importer.columns.expected(),
      [&](std::string_view line) { importer.columns.take_header(line); },
      [&](std::string_view line) { importer.row(line); });
  return std::move(importer.fabrics);
}

}  // namespace drape
