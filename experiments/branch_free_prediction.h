// What fits predict of drapes whose branch is not given: one drape by each protocol, held against
// all photographs of the fabric.
//
// Which protocol folds cloth as hands and instrument do is learned from other fabrics: each fabric
// is predicted by the protocol with the least error of the drape coefficient, in the median over
// all fabrics but this one.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace drape {

/// One fabric without its branch, and what was seen of it.
struct DrapedByProtocols {
  /// [{"protocol", "drape_coefficient_percent", "node_count"}, ..]; a drape that failed has the
  /// first alone.
  nlohmann::ordered_json drapes;
  std::vector<double> drape_coefficients;  ///< of its photographs [percent]
  std::vector<double> node_counts;         ///< of its photographs
};

struct BranchFreePredictions {
  /// Of each fabric: "protocol", "drape_coefficient_percent" and "node_count" predicted,
  /// "drape_coefficient_error" and "node_error" against the medians of its photographs,
  /// "drape_coefficient_sd_of_photographs", and the "drape_coefficients" and "node_counts" of every
  /// protocol. Null where no protocol has a drape.
  std::vector<nlohmann::ordered_json> fabrics;
  /// Medians over fabrics, and of each protocol by itself: "by_protocol".
  nlohmann::ordered_json summary;
};

/// A fabric without others to learn from is predicted by its first drape.
BranchFreePredictions predict_without_branch(const std::vector<DrapedByProtocols>& fabrics);

}  // namespace drape
