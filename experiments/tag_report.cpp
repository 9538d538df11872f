#include "experiments/tag_report.h"

#include <cstdio>
#include <stdexcept>

#include "estimation/csv_table.h"
#include "estimation/tag_model.h"
#include "experiments/tag_names.h"

namespace drape {
namespace {

/// No cloth weighs more [kg/m^2].
constexpr double kHeaviest = 5;

double checked_density(double density) {
  if (density > kHeaviest)
    throw std::invalid_argument("density " + shown(density) + " kg/m^2: no cloth is that heavy; " +
                                "if it is in g/m^2, write " + shown(density / 1000));
  if (!(density > 0))
    throw std::invalid_argument("density " + shown(density) + " kg/m^2: must be positive");
  return density;
}

}  // namespace

std::string tag_report(const std::string& type_text, const std::string& composition, double density,
                       BendingThreshold threshold) {
  const FabricType& type = type_from_text(type_text);
  const Tag tag{
      std::string(type.name), std::string(type.category),          std::string(type.subcategory),
      std::string(type.name), composition_from_words(composition), checked_density(density)};
  std::string report = tag.type + " (" + tag.category + ", " + tag.subcategory + "), " +
                       composition_text(tag.composition) + ", " + shown(density) + " kg/m^2\n";
  if (density < type.light || density > type.heavy)
    report +=
        "Of this type most weigh " + shown(type.light) + " to " + shown(type.heavy) + " kg/m^2.\n";
  char line[160];
  std::snprintf(line, sizeof line, "\n%-15s%12s%12s%12s  %s\n", "", "5 %", "median", "95 %",
                "unit");
  report += line;
  const auto ranges = parameter_ranges(tag, threshold);
  for (Parameter p : all_parameters()) {
    const ParameterRange& range = ranges[static_cast<size_t>(p)];
    const ParameterInfo& about = info(p);
    std::snprintf(line, sizeof line, "%-15.*s%12.3g%12.3g%12.3g  %-7.*s %.*s\n",
                  static_cast<int>(about.name.size()), about.name.data(), range.low, range.median,
                  range.high, static_cast<int>(about.unit.size()), about.unit.data(),
                  static_cast<int>(about.meaning.size()), about.meaning.data());
    report += line;
  }
  return report +
         "\nNine of ten fabrics with such a tag lie between 5 and 95 %, by the tag model " +
         "(bending as a bending\ntest gives it; t_b in the reading \"" +
         std::string(name(threshold)) + "\"). A photograph tells more: drape estimate --photo.\n";
}

}  // namespace drape
