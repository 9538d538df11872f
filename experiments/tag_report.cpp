#include "experiments/tag_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "core/records.h"
#include "estimation/csv_table.h"
#include "estimation/tag_model.h"
#include "experiments/tag_dataset.h"
#include "experiments/tag_names.h"

namespace drape {
namespace {

/// No cloth weighs more [kg/m^2].
constexpr double kHeaviest = 5;
/// Standard deviations of a normal between the median and 95 %.
constexpr double kTo95 = 1.645;

double checked_density(double density) {
  if (density > kHeaviest)
    throw std::invalid_argument("density " + shown(density) + " kg/m^2: no cloth is that heavy; " +
                                "if it is in g/m^2, write " + shown(density / 1000));
  if (!(density > 0))
    throw std::invalid_argument("density " + shown(density) + " kg/m^2: must be positive");
  return density;
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char line[200];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

/// What the tag is, and whether that is usual.
std::string heading(const Tag& tag) {
  const std::string text = tag.type + " (" + tag.category + ", " + tag.subcategory + "), " +
                           composition_text(tag.composition) + ", " + shown(tag.areal_density) +
                           " kg/m^2\n";
  const FabricType& type = *find_type(tag.type);
  if (tag.areal_density >= type.light && tag.areal_density <= type.heavy) return text;
  return text + "Of this type most weigh " + shown(type.light) + " to " + shown(type.heavy) +
         " kg/m^2.\n";
}

/// `quality` is a last column of numbers, or empty.
std::string row(Parameter p, const ParameterRange& range, const std::string& quality) {
  const ParameterInfo& about = info(p);
  return formatted("%-15.*s%12.3g%12.3g%12.3g%s  %-7.*s %.*s\n",
                   static_cast<int>(about.name.size()), about.name.data(), range.low, range.median,
                   range.high, quality.c_str(), static_cast<int>(about.unit.size()),
                   about.unit.data(), static_cast<int>(about.meaning.size()), about.meaning.data());
}

std::string column_heads(const std::string& quality) {
  return formatted("\n%-15s%12s%12s%12s%s  %s\n", "", "5 %", "median", "95 %", quality.c_str(),
                   "unit");
}

/// Of a parameter whose z is normal, cut off at what the parameter may be.
ParameterRange range_of(Parameter p, double mean, double sd) {
  const auto value = [&](double z) {
    return is_logarithmic(p) ? std::exp(z) : std::clamp(z, info(p).minimum, info(p).maximum);
  };
  return {value(mean - kTo95 * sd), value(mean), value(mean + kTo95 * sd)};
}

constexpr const char* kMore = "A photograph tells more: drape estimate --photo.\n";

}  // namespace

Tag tag_from_words(const std::string& type_text, const std::string& composition, double density) {
  const FabricType& type = type_from_text(type_text);
  return {
      std::string(type.name), std::string(type.category),          std::string(type.subcategory),
      std::string(type.name), composition_from_words(composition), checked_density(density)};
}

std::string tag_report(const Tag& tag, BendingThreshold threshold) {
  std::string report = heading(tag) + column_heads("");
  const auto ranges = parameter_ranges(tag, threshold);
  for (const Parameter p : all_parameters()) report += row(p, ranges[static_cast<size_t>(p)], "");
  return report +
         "\nNine of ten fabrics with such a tag lie between 5 and 95 %, by the tag model " +
         "(bending as a bending\ntest gives it; t_b in the reading \"" +
         std::string(name(threshold)) + "\"). " + kMore;
}

std::string tag_report(const Tag& tag, const std::filesystem::path& results) {
  const TagRegression regression = tag_regression(results);
  const std::vector<Parameter> all(all_parameters().begin(), all_parameters().end());
  const Prior prior = regression.predict(all, tag);
  std::string report = heading(tag) + column_heads(formatted("%8s", "R^2"));
  for (const Parameter p : all) {
    const auto i = static_cast<int>(p);
    const TagRegression::Validation& validation = regression.validation(p);
    const bool learned = p != Parameter::areal_density && validation.varies;
    // adding 0 makes a rounded -0 a 0
    report += row(p, range_of(p, prior.mean[i], std::sqrt(prior.covariance(i, i))),
                  learned ? formatted("%8.2f", std::round(100 * validation.r_squared) / 100 + 0.)
                          : formatted("%8s", "-"));
  }
  report +=
      "\nNine of ten fabrics with such a tag should lie between 5 and 95 %, by a regression "
      "on the tags of the\n" +
      std::to_string(regression.fabrics()) + " fabrics of " + results.string();
  if (std::isfinite(regression.coverage()))
    report += formatted("; in cross-validation %.1f %% did", 100 * regression.coverage());
  return report + " (t_b in the\nreading \"" +
         std::string(name(read_header(results).reading.threshold)) +
         "\"). R^2: share of the variance of the logarithm, of t_b itself, that is predicted for\n"
         "fabrics left out; \"-\": not learned, the weight is given and what does not vary there "
         "is "
         "assumed.\n" +
         kMore;
}

}  // namespace drape
