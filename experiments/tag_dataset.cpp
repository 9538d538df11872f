#include "experiments/tag_dataset.h"

#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/records.h"
#include "experiments/dataset_fabrics.h"
#include "experiments/tag_names.h"

namespace drape {

TagRegression tag_regression(const std::filesystem::path& results) {
  std::vector<TaggedFabric> fabrics;
  std::set<std::pair<std::string, std::vector<double>>> seen;
  try {
    visit_records(results, [&](size_t, const Record& record) {
      if (record.category.empty()) return;
      const ParameterVector values = to_vector(record.fabric);
      if (!seen.insert({record.type + ";" + record.composition, {values.begin(), values.end()}})
               .second)
        return;
      try {
        fabrics.push_back({in_known_words(tag_of(record)), record.fabric});
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument("fabric '" + record.id + "': " + error.what());
      }
    });
    return TagRegression(fabrics);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(results.string() + ": " + error.what());
  }
}

TagPrior tag_prior(const EstimateSettings& settings, BendingThreshold threshold) {
  const std::filesystem::path& results = settings.tag_dataset;
  if (results.empty())
    return [threshold](const std::vector<Parameter>& parameters, const Tag& tag) {
      return prior_from_tag(parameters, tag, threshold);
    };
  const BendingThreshold learned = read_header(results).reading.threshold;
  if (learned != threshold)
    throw std::invalid_argument("estimate.tag_dataset " + results.string() +
                                " has bending thresholds of the reading \"" +
                                std::string(name(learned)) + "\", the fabrics to estimate \"" +
                                std::string(name(threshold)) + "\"");
  const auto regression = std::make_shared<const TagRegression>(tag_regression(results));
  return [regression](const std::vector<Parameter>& parameters, const Tag& tag) {
    return regression->predict(parameters, in_known_words(tag));
  };
}

}  // namespace drape
