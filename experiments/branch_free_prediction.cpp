#include "experiments/branch_free_prediction.h"

#include <cmath>
#include <map>
#include <string>

#include "experiments/json_store.h"
#include "experiments/statistics.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

/// What one protocol's drape of a fabric is off by.
struct Miss {
  size_t fabric;
  double drape_coefficient, nodes;
};
using Misses = std::map<std::string, std::vector<Miss>>;  // by protocol

bool is_draped(const Json& drape) { return drape.contains("node_count"); }

Misses misses_of(const std::vector<DrapedByProtocols>& fabrics) {
  Misses misses;
  for (size_t i = 0; i < fabrics.size(); ++i)
    for (const Json& drape : fabrics[i].drapes)
      if (is_draped(drape))
        misses[drape["protocol"]].push_back(
            {i, number(drape["drape_coefficient_percent"]) - median(fabrics[i].drape_coefficients),
             number(drape["node_count"]) - median(fabrics[i].node_counts)});
  return misses;
}

/// Median of the absolute errors of the drape coefficient over all fabrics but one; infinite if
/// there is none.
double error_without(const std::vector<Miss>& misses, size_t left_out) {
  std::vector<double> errors;
  for (const Miss& miss : misses)
    if (miss.fabric != left_out) errors.push_back(std::abs(miss.drape_coefficient));
  return errors.empty() ? INFINITY : median(errors);
}

/// The drape of the protocol that is best on the other fabrics; null if there is no drape.
const Json* predicted(const Json& drapes, const Misses& misses, size_t fabric) {
  const Json* best = nullptr;
  double least = INFINITY;
  for (const Json& drape : drapes) {
    if (!is_draped(drape)) continue;
    const double error = error_without(misses.at(drape["protocol"]), fabric);
    if (best != nullptr && !(error < least)) continue;
    best = &drape;
    least = error;
  }
  return best;
}

Json held_against(const Json& drape, const DrapedByProtocols& fabric) {
  Json all_coefficients = Json::array(), all_nodes = Json::array();
  for (const Json& other : fabric.drapes) {
    if (!is_draped(other)) continue;
    all_coefficients.push_back(other["drape_coefficient_percent"]);
    all_nodes.push_back(other["node_count"]);
  }
  const double coefficient = number(drape["drape_coefficient_percent"]);
  const double nodes = number(drape["node_count"]);
  return {{"protocol", drape["protocol"]},
          {"drape_coefficient_percent", coefficient},
          {"node_count", nodes},
          {"drape_coefficient_error", coefficient - median(fabric.drape_coefficients)},
          {"node_error", nodes - median(fabric.node_counts)},
          {"drape_coefficient_sd_of_photographs", standard_deviation(fabric.drape_coefficients)},
          {"drape_coefficients", all_coefficients},
          {"node_counts", all_nodes}};
}

Json account_of(const std::vector<Miss>& misses) {
  std::vector<double> errors, signed_errors, nodes;
  for (const Miss& miss : misses) {
    errors.push_back(std::abs(miss.drape_coefficient));
    signed_errors.push_back(miss.drape_coefficient);
    nodes.push_back(miss.nodes);
  }
  return {{"fabrics", misses.size()},
          {"drape_coefficient_error_median", median(errors)},
          {"drape_coefficient_bias_median", median(signed_errors)},
          {"node_bias_median", median(nodes)}};
}

}  // namespace

BranchFreePredictions predict_without_branch(const std::vector<DrapedByProtocols>& fabrics) {
  const Misses misses = misses_of(fabrics);
  BranchFreePredictions result;
  std::vector<Miss> chosen;
  std::vector<double> scatter;
  for (size_t i = 0; i < fabrics.size(); ++i) {
    const Json* drape = predicted(fabrics[i].drapes, misses, i);
    result.fabrics.push_back(drape != nullptr ? held_against(*drape, fabrics[i]) : Json());
    if (drape == nullptr) continue;
    const Json& row = result.fabrics.back();
    chosen.push_back({i, number(row["drape_coefficient_error"]), number(row["node_error"])});
    scatter.push_back(number(row["drape_coefficient_sd_of_photographs"]));
  }
  result.summary = account_of(chosen);
  result.summary["drape_coefficient_sd_of_photographs_median"] = median(scatter);
  for (const auto& [protocol, of_protocol] : misses)
    result.summary["by_protocol"][protocol] = account_of(of_protocol);
  return result;
}

}  // namespace drape
