// kind = "gradient_check": adjoint gradients of random fabrics against re-solved equilibria.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "experiments/gradient_check.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/random_fabric.h"
#include "experiments/record_store.h"
#include "experiments/statistics.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kTargetError = 1e-6, kTargetTangent = 1e-8;
constexpr double kTargetExcluded = 0.05, kTargetCost = 0.5;

/// Stiff to medium fabrics, heavy enough that some wings are bent past their threshold, and with
/// stiffness factors away from 1: below and above it in turn.
Fabric checked_fabric(std::uint64_t seed, int index) {
  FabricBox box;
  box.areal_density = {0.1, 0.4};
  box.flexural_rigidity = {1e-5, 1e-4};
  box.past_threshold = index % 2 == 0 ? Interval{0.3, 0.8} : Interval{1.2, 2};
  box.threshold = {0.3, 0.5};
  Random random(seed);
  return random_fabric(random, box);
}

/// What the report needs of a finished check.
void add_check(const GradientCheck& result, Json& item) {
  item["forward_cpu_seconds"] = result.forward_cpu_seconds;
  item["adjoint_cpu_seconds"] = result.adjoint_cpu_seconds;
  item["unit_cpu_seconds"] = result.unit_cpu_seconds;
  item["adjoint_versus_tangent"] = result.adjoint_versus_tangent;
  item["wings"] = result.wings;
  item["wings_past_threshold"] = result.wings_past_threshold;
  for (const ParameterCheck& c : result.parameters)
    item["parameters"][std::string(name(c.parameter))] = {{"adjoint", c.adjoint},
                                                          {"difference", c.difference},
                                                          {"differences", c.differences},
                                                          {"extrapolated", c.extrapolated},
                                                          {"step", c.step},
                                                          {"error", c.error},
                                                          {"excluded", c.excluded}};
}

/// Checks the `index`-th fabric; `record` becomes its record, whatever happens.
Json check(const Settings& settings, std::shared_ptr<const Discretization> discretization,
           int index, Record& record) {
  const std::uint64_t seed =
      seed_of_item(settings.experiment.seed, static_cast<std::uint64_t>(index));
  Json item = {{"index", index}, {"seed", seed}};
  const std::string exception = fill_record(record, index, [&] {
    const Fabric fabric = checked_fabric(seed, index);
    record = failed_record(settings, discretization->mesh(), fabric, "not solved");
    const GradientCheck result =
        check_gradient(settings, discretization, fabric, seed_of_item(seed, 0));
    record = result.record;
    item["status"] = result.status;
    if (result.status == "ok") add_check(result, item);
  });
  if (!exception.empty()) item["status"] = exception;
  return item;
}

Json account(const std::vector<Json>& items, const Settings& settings) {
  const auto steps = static_cast<int>(settings.gradient_check.steps.size());
  std::vector<double> errors, over_forward, units, tangent;
  int excluded = 0, taken = 0, unchecked = 0, both_regimes = 0;
  Json per_parameter = Json::object(), excluded_per_parameter = Json::object();
  Json failures = Json::array();
  for (const Json& item : items) {
    if (item["status"] != "ok") {
      failures.push_back(
          {{"seed", item["seed"]}, {"index", item["index"]}, {"reason", item["status"]}});
      continue;
    }
    const double cpu = number(item["adjoint_cpu_seconds"]);
    over_forward.push_back(cpu / number(item["forward_cpu_seconds"]));
    units.push_back(cpu / number(item["unit_cpu_seconds"]));
    tangent.push_back(number(item["adjoint_versus_tangent"]));
    const int past = item["wings_past_threshold"];
    both_regimes += past > 0 && past < item["wings"].get<int>();
    for (const auto& [parameter, entry] : item["parameters"].items()) {
      taken += steps;
      excluded += entry["excluded"].get<int>();
      excluded_per_parameter[parameter] =
          excluded_per_parameter.value(parameter, 0) + entry["excluded"].get<int>();
      const double error = number(entry["error"]);
      unchecked += std::isnan(error);
      errors.push_back(error);
      per_parameter[parameter] = std::fmax(error, per_parameter.value(parameter, 0.0));
    }
  }
  return {{"fabrics", items.size()},
          {"max_relative_error", percentile(errors, 100)},
          {"median_relative_error", median(errors)},
          {"per_parameter", per_parameter},
          {"adjoint_over_forward_cpu", median(over_forward)},
          {"adjoint_factorization_equivalents", median(units)},
          {"excluded_steps", taken > 0 ? static_cast<double>(excluded) / taken : NAN},
          {"excluded_steps_per_parameter", excluded_per_parameter},
          {"unchecked_derivatives", unchecked},
          {"adjoint_versus_tangent_max", percentile(tangent, 100)},
          {"fabrics_with_both_regimes", both_regimes},
          {"failures", failures}};
}

bool print_target(const char* what, double value, double target) {
  const bool met = value <= target;  // false for NaN
  std::printf("%s: %s %.2g, target %.2g\n", met ? "PASS" : "FAIL", what, value, target);
  return met;
}

/// The table and the verdict against the targets.
bool print_report(const Json& summary) {
  std::printf("%-14s %12s %15s\n", "parameter", "worst error", "excluded steps");
  for (const auto& [parameter, error] : summary["per_parameter"].items())
    std::printf("%-14s %12.1e %15d\n", parameter.c_str(), number(error),
                summary["excluded_steps_per_parameter"][parameter].get<int>());
  std::printf("adjoint over forward CPU (median): %.2g\n",
              number(summary["adjoint_over_forward_cpu"]));
  const int unchecked = summary["unchecked_derivatives"];
  bool met =
      print_target("worst gradient error", number(summary["max_relative_error"]), kTargetError);
  const int one_regime =
      summary["fabrics"].get<int>() - summary["fabrics_with_both_regimes"].get<int>();
  met &= print_target("derivatives left unchecked", unchecked, 0);
  met &= print_target("fabrics without both regimes of bending", one_regime, 0);
  met &=
      print_target("share of excluded steps", number(summary["excluded_steps"]), kTargetExcluded);
  met &= print_target("adjoint against tangent", number(summary["adjoint_versus_tangent_max"]),
                      kTargetTangent);
  met &= print_target("adjoint, factorisation-equivalents (median)",
                      number(summary["adjoint_factorization_equivalents"]), kTargetCost);
  return met;
}

}  // namespace

RunOutcome run_gradient_check(const Settings& settings, OutputFolder& folder) {
  const int fabrics = settings.gradient_check.fabrics;
  const JsonStore store(folder, "fabrics");
  const auto discretization = make_discretization(settings);
  const RecordStore records(folder.path(), records_header(settings, discretization->mesh()),
                            fabrics);
  int resumed = 0;
  for (int i = 0; i < fabrics; ++i) resumed += store.has(std::to_string(i));
  {
    Progress progress("gradient check", fabrics, resumed);
    for_each_item(fabrics, settings.experiment.thread_count(), [&](int i) {
      if (store.has(std::to_string(i))) return;
      Record record;
      const Json item = check(settings, discretization, i, record);
      records.save(i, record);
      store.save(std::to_string(i), item);
      progress.advance();
    });
  }
  if (interrupted()) return {"partial", {}};
  records.consolidate();

  std::vector<Json> items;
  for (int i = 0; i < fabrics; ++i) items.push_back(store.load(std::to_string(i)));
  RunOutcome outcome{"", account(items, settings)};
  outcome.summary["targets_met"] = print_report(outcome.summary);
  const size_t failed = outcome.summary["failures"].size();
  outcome.status = failed == 0 ? "ok" : failed < items.size() ? "partial" : "failed";
  return outcome;
}

}  // namespace drape
