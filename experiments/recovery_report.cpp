#include "experiments/recovery_report.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "estimation/parameter_space.h"
#include "experiments/interval_coverage.h"
#include "experiments/statistics.h"

namespace drape {
namespace {

constexpr double kIdentifiable = 0.2;  // log standard deviation of a parameter that is seen
constexpr double kBendingError = 0.02, kShearError = 0.10;  // what counts as recovered
constexpr double kNoMisfit = 0.01;                          // of the stated noise
constexpr double kAtBound = 1e-3;                           // of the logarithm

bool is_recovered(const Record& record, const std::vector<Parameter>& parameters) {
  for (Parameter p : parameters) {
    const double error = std::abs(record.estimate->fabric[p] / record.fabric[p] - 1);
    if (!(error <= (p == Parameter::k_h ? kShearError : kBendingError))) return false;
  }
  return record.estimate->outcome == name(EstimateOutcome::succeeded);
}

bool at_bound(const EstimateRecord& estimate, const EstimateSettings& settings) {
  for (Parameter p : settings.parameters)
    if (is_logarithmic(p) && std::abs(std::log(estimate.fabric[p] / estimate.start[p])) >
                                 std::log(settings.bounds) - kAtBound)
      return true;
  return false;
}

/// 10 per cent wide, so that the soft and the stiff can be told from the rest.
std::string drape_coefficient_band(const Record& record) {
  const int tens = std::clamp(static_cast<int>(10 * record.observation.drape_coefficient), 0, 9);
  return std::to_string(10 * tens) + "-" + std::to_string(10 * tens + 10);
}

std::string type_group(const Record& record) {
  if (record.category.empty()) return "no tag";
  return record.subcategory.empty() ? record.category : record.category + ", " + record.subcategory;
}

double mean_bending(const Fabric& fabric) { return (fabric.k_bu + fabric.k_bv + fabric.k_bh) / 3; }

/// One line of a table of errors, over fits of every outcome.
nlohmann::ordered_json error_line(const std::vector<const Record*>& records,
                                  const EstimateSettings& settings) {
  std::vector<double> bending, shear, rms, cpu;
  int recovered = 0, succeeded = 0;
  for (const Record* record : records) {
    const EstimateRecord& e = *record->estimate;
    recovered += is_recovered(*record, settings.parameters);
    succeeded += e.outcome == name(EstimateOutcome::succeeded);
    bending.push_back(std::abs(mean_bending(e.fabric) / mean_bending(record->fabric) - 1));
    shear.push_back(std::abs(e.fabric.k_h / record->fabric.k_h - 1));
    rms.push_back(1e3 * e.outline_rms);
    cpu.push_back(e.stats.cpu_seconds);
  }
  return {{"fabrics", records.size()},
          {"succeeded", succeeded},
          {"recovered", recovered},
          {"median_mean_k_b_error", median(bending)},
          {"median_k_h_error", median(shear)},
          {"median_outline_rms_mm", median(rms)},
          {"mean_cpu_seconds", mean(cpu)}};
}

/// The lines of a table of errors, by what `group` says of a fabric.
nlohmann::ordered_json error_table(const std::vector<Record>& records,
                                   const EstimateSettings& settings,
                                   std::string (*group)(const Record&)) {
  std::map<std::string, std::vector<const Record*>> groups;
  for (const Record& record : records)
    if (record.estimate) groups[group(record)].push_back(&record);
  nlohmann::ordered_json table = nlohmann::ordered_json::object();
  for (const auto& [label, members] : groups) table[label] = error_line(members, settings);
  return table;
}

}  // namespace

std::string recovery_class(const Record& record, const EstimateSettings& settings) {
  const EstimateRecord& estimate = *record.estimate;
  if (is_recovered(record, settings.parameters)) return "recovered";
  if (at_bound(estimate, settings)) return "bounds";
  if (estimate.outcome != name(EstimateOutcome::succeeded)) return estimate.outcome;
  if (estimate.node_count != record.observation.node_count) return "wrong_node_count";
  return estimate.outline_rms > kNoMisfit * settings.outline_noise ? "neighbouring_branch"
                                                                   : "insensitive";
}

nlohmann::ordered_json recovery_summary(const EstimateSettings& settings,
                                        const std::vector<Record>& records) {
  std::vector<double> rms, dc_error, iou, solves, cpu;
  int succeeded = 0, shared = 0, recovered = 0, shared_recovered = 0;
  std::vector<std::vector<double>> error(settings.parameters.size());
  std::vector<int> identifiable(settings.parameters.size(), 0);
  std::map<std::string, int> failures;
  for (const Record& record : records) {
    if (!record.estimate) continue;
    const EstimateRecord& e = *record.estimate;
    const std::string end = recovery_class(record, settings);
    const bool is_recovered = end == "recovered";
    if (!is_recovered) ++failures[end];
    shared += e.branch_shared;
    recovered += is_recovered;
    shared_recovered += e.branch_shared && is_recovered;
    solves.push_back(e.forward_solves);
    cpu.push_back(e.stats.cpu_seconds);
    if (e.outcome != name(EstimateOutcome::succeeded)) continue;
    ++succeeded;
    rms.push_back(1e3 * e.outline_rms);
    dc_error.push_back(std::abs(e.drape_coefficient - record.observation.drape_coefficient));
    iou.push_back(e.iou);
    for (size_t i = 0; i < error.size(); ++i) {
      const Parameter p = settings.parameters[i];
      error[i].push_back(std::abs(e.fabric[p] / record.fabric[p] - 1));
      identifiable[i] += e.log_sd[static_cast<int>(p)] < kIdentifiable;
    }
  }
  nlohmann::ordered_json summary;
  summary["fabrics"] = records.size();
  summary["succeeded"] = succeeded;
  summary["recovered"] = recovered;
  summary["by_drape_coefficient"] = error_table(records, settings, drape_coefficient_band);
  summary["by_type"] = error_table(records, settings, type_group);
  summary["failures"] = failures;
  if (settings.start == EstimateStart::continued) {
    summary["branches_shared"] = shared;
    summary["recovered_of_shared"] = shared_recovered;
  }
  for (size_t i = 0; i < error.size(); ++i) {
    const std::string parameter(name(settings.parameters[i]));
    summary["median_parameter_error"][parameter] = median(error[i]);
    summary["identifiable"][parameter] = succeeded > 0 ? 1.0 * identifiable[i] / succeeded : 0.0;
  }
  summary["coverage_68"] = interval_coverage(records, settings.parameters, k68);
  summary["coverage_95"] = interval_coverage(records, settings.parameters, k95);
  summary["median_outline_rms_mm"] = median(rms);
  summary["median_drape_coefficient_error"] = median(dc_error);
  summary["iou_median"] = median(iou);
  summary["forward_solves_median"] = median(solves);
  summary["cpu_seconds_median"] = median(cpu);
  return summary;
}

}  // namespace drape
