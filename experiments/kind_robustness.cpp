// kind = "robustness": cold drapes of random fabrics on meshes of several sizes; every one must end
// at a certified minimum with a residual of 1e-8 or of the rounding floor.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "experiments/factorization_unit.h"
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

constexpr double kTargetResidual = 1e-8;

std::string item_name(int vertices, int index) {
  return std::to_string(vertices) + "_" + std::to_string(index);
}

/// Drapes the `index`-th random fabric; `record` becomes its record, whatever happens.
Json solve(const Settings& settings, std::shared_ptr<const Discretization> discretization,
           int index, Record& record) {
  const std::uint64_t seed =
      seed_of_item(settings.experiment.seed, static_cast<std::uint64_t>(index));
  Json item = {{"index", index}, {"seed", seed}};
  try {
    Random random(seed);
    const Fabric fabric = random_fabric(random);
    record = failed_record(settings, discretization->mesh(), fabric, "not solved");
    const Potential potential = make_potential(discretization, fabric, settings);
    const Equilibrium equilibrium = drape(settings, potential);
    record = make_record(settings, potential, equilibrium);
    item["status"] = name(equilibrium.status);
    item["vertices"] = potential.mesh().vertex_count();
    item["residual"] = equilibrium.residual;
    item["rounding_floor"] = potential.rounding_floor(equilibrium.x);
    item["negative_eigenvalues"] = equilibrium.negative_eigenvalues;
    item["newton_iterations"] = equilibrium.newton_iterations;
    item["factorizations"] = equilibrium.factorizations;
    item["drape_cpu_seconds"] = equilibrium.cpu_seconds;
    item["factorization_equivalents"] =
        equilibrium.cpu_seconds / factorization_unit(potential, equilibrium.x);
  } catch (const std::exception& error) {
    item["status"] = record.stats.status = error.what();
  }
  record.id = record.name = std::to_string(index);
  return item;
}

std::vector<double> column(const std::vector<Json>& items, const char* key) {
  std::vector<double> values;
  for (const Json& item : items)
    if (item.contains(key)) values.push_back(number(item[key]));
  return values;
}

double worst(const std::vector<double>& values) { return percentile(values, 100); }

/// The keys of interface and table for a set of solves.
Json account(const std::vector<Json>& items) {
  int converged_count = 0, certified = 0;
  Json failures = Json::array();
  std::vector<double> over_target;
  for (const Json& item : items) {
    const double residual = item.contains("residual") ? number(item["residual"]) : NAN;
    const double floor = item.contains("residual") ? number(item["rounding_floor"]) : NAN;
    const double share = residual / std::max(kTargetResidual, floor);
    const bool good = item["status"] == "converged" && share <= 1;
    converged_count += good;
    certified += item.contains("residual") && item["negative_eigenvalues"] == 0;
    over_target.push_back(share);
    if (!good)
      failures.push_back({{"seed", item["seed"]},
                          {"index", item["index"]},
                          {"vertices", item.value("vertices", Json())},
                          {"reason", item["status"]}});
  }
  return {{"fabrics", items.size()},
          {"converged", converged_count},
          {"certified_minima", certified},
          {"worst_residual", worst(column(items, "residual"))},
          {"worst_rounding_floor", worst(column(items, "rounding_floor"))},
          {"worst_residual_over_target", worst(over_target)},
          {"cpu_seconds_percentiles", percentiles(column(items, "drape_cpu_seconds"))},
          {"factorizations_percentiles", percentiles(column(items, "factorizations"))},
          {"factorization_equivalents_percentiles",
           percentiles(column(items, "factorization_equivalents"))},
          {"failures", failures}};
}

void print_head() {
  std::printf("%9s %8s %10s %10s %9s %9s %9s   %-18s %-18s %-18s\n", "vertices", "fabrics",
              "converged", "certified", "residual", "floor", "/ target", "CPU s 50/95/100 %",
              "factor. 50/95/100", "units 50/95/100");
}

std::string three(const Json& of, const char* format) {
  char text[96];
  std::snprintf(text, sizeof text, format, number(of["50"]), number(of["95"]), number(of["100"]));
  return text;
}

void print_row(int vertices, const Json& row) {
  std::printf("%9d %8d %10d %10d %9.1e %9.1e %9.2f   %-18s %-18s %-18s\n", vertices,
              row["fabrics"].get<int>(), row["converged"].get<int>(),
              row["certified_minima"].get<int>(), number(row["worst_residual"]),
              number(row["worst_rounding_floor"]), number(row["worst_residual_over_target"]),
              three(row["cpu_seconds_percentiles"], "%.2f/%.2f/%.2f").c_str(),
              three(row["factorizations_percentiles"], "%.0f/%.0f/%.0f").c_str(),
              three(row["factorization_equivalents_percentiles"], "%.0f/%.0f/%.0f").c_str());
}

}  // namespace

RunOutcome run_robustness(const Settings& settings, OutputFolder& folder) {
  const int fabrics = settings.robustness.fabrics;
  const JsonStore store(folder, "solves");
  Json per_size = Json::object();
  std::vector<Json> all;
  print_head();
  for (int vertices : settings.robustness.vertices) {
    int resumed = 0;
    for (int i = 0; i < fabrics; ++i) resumed += store.has(item_name(vertices, i));
    const std::filesystem::path part = folder / ("vertices_" + std::to_string(vertices));
    if (!std::filesystem::exists(part / "results.h5")) {
      const auto discretization = make_discretization(settings, vertices);
      const RecordStore records(part, records_header(settings, discretization->mesh()), fabrics);
      Progress progress("robustness, " + std::to_string(vertices) + " vertices", fabrics, resumed);
      for_each_item(fabrics, settings.experiment.thread_count(), [&](int i) {
        if (store.has(item_name(vertices, i))) return;
        Record record;
        const Json item = solve(settings, discretization, i, record);
        records.save(i, record);
        store.save(item_name(vertices, i), item);
        progress.advance();
      });
      if (interrupted()) return {"partial", {}};
      records.consolidate();
    }
    std::vector<Json> items;
    for (int i = 0; i < fabrics; ++i) items.push_back(store.load(item_name(vertices, i)));
    const Json row = account(items);
    print_row(vertices, row);
    per_size[std::to_string(vertices)] = row;
    all.insert(all.end(), items.begin(), items.end());
  }

  RunOutcome outcome{"", account(all)};
  const auto total = static_cast<int>(all.size());
  const int converged_count = outcome.summary["converged"];
  outcome.status = converged_count == total ? "ok" : converged_count > 0 ? "partial" : "failed";
  const bool met = converged_count == total && outcome.summary["certified_minima"] == total;
  outcome.summary["per_size"] = per_size;
  outcome.summary["targets_met"] = met;
  std::printf("%s: residual <= max(%.0e, rounding floor) at certified minima: %d of %d\n",
              met ? "PASS" : "FAIL", kTargetResidual, converged_count, total);
  return outcome;
}

}  // namespace drape
