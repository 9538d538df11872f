#include "experiments/recovery_report.h"

#include <array>
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

struct Band {
  const char* label;
  double low, high;  // drape coefficient
};
constexpr std::array<Band, 4> kBands{
    {{"0-15", 0, 0.15}, {"15-55", 0.15, 0.55}, {"55-80", 0.55, 0.8}, {"80-100", 0.8, 1.01}}};

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
  std::array<int, kBands.size()> band_recovered{}, band_fabrics{};
  for (const Record& record : records) {
    if (!record.estimate) continue;
    const EstimateRecord& e = *record.estimate;
    const std::string end = recovery_class(record, settings);
    const bool is_recovered = end == "recovered";
    if (!is_recovered) ++failures[end];
    for (size_t b = 0; b < kBands.size(); ++b) {
      const double dc = record.observation.drape_coefficient;
      if (dc < kBands[b].low || dc >= kBands[b].high) continue;
      ++band_fabrics[b];
      band_recovered[b] += is_recovered;
    }
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
  for (size_t b = 0; b < kBands.size(); ++b)
    if (band_fabrics[b] > 0)
      summary["recovered_by_drape_coefficient"][kBands[b].label] = {
          {"fabrics", band_fabrics[b]}, {"recovered", band_recovered[b]}};
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
