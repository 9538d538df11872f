// kind = "robustness": cold drapes of random fabrics, half of them of the measured distribution and
// half from a much wider box; every one must end at a certified minimum with a residual of 1e-8 or
// of the rounding floor.
//
// Fabric `index` is the same in every run of a seed, whatever the number of fabrics: even indices
// are measured ones, odd ones wide. robustness.only solves some of them again.
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "core/durable_file.h"
#include "experiments/fabric_distribution.h"
#include "experiments/factorization_unit.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/record_store.h"
#include "experiments/robustness_report.h"

namespace drape {
namespace {

using Solves = std::vector<RobustnessSolve>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

FabricDistribution distribution_of(int index) {
  return index % 2 == 0 ? FabricDistribution::measured : FabricDistribution::wide;
}

std::string item_name(int size, int index) {
  return std::to_string(size) + "_" + std::to_string(index);
}

std::vector<int> indices(const RobustnessSettings& settings) {
  std::vector<int> list = settings.only;
  if (list.empty())
    for (int i = 0; i < settings.fabrics; ++i) list.push_back(i);
  return list;
}

/// Drapes the `index`-th random fabric; `record` becomes its record, whatever happens.
RobustnessSolve solve(const Settings& settings,
                      std::shared_ptr<const Discretization> discretization, int size, int index,
                      Record& record) {
  RobustnessSolve solve;
  solve.index = index;
  solve.seed = seed_of_item(settings.experiment.seed, static_cast<std::uint64_t>(index));
  solve.distribution = name(distribution_of(index));
  solve.size = size;
  solve.bending_length = solve.residual = solve.rounding_floor = kNaN;
  solve.cpu_seconds = solve.unit_cpu_seconds = kNaN;
  const std::string exception = fill_record(record, index, [&] {
    Random random(solve.seed);
    const Fabric fabric = random_fabric(random, distribution_of(index));
    record = failed_record(settings, discretization->mesh(), fabric, "not solved");
    solve.bending_length = bending_length(fabric, settings.scene.gravity);
    Potential potential = make_potential(discretization, fabric, settings);
    const ContactDrape draped = drape(settings, potential);
    const Equilibrium& equilibrium = draped.equilibrium;
    record = make_record(settings, potential, equilibrium);
    solve.residual = equilibrium.residual;
    solve.rounding_floor = potential.rounding_floor(equilibrium.x);
    solve.negative_eigenvalues = equilibrium.negative_eigenvalues;
    solve.newton_iterations = equilibrium.newton_iterations;
    solve.factorizations = equilibrium.factorizations;
    solve.wings_past_threshold = record.stats.wings_past_threshold;
    solve.contact_with_support = draped.contact.support;
    solve.self_intersections = record.stats.self_intersections;
    solve.cpu_seconds = equilibrium.cpu_seconds;
    solve.unit_cpu_seconds = factorization_unit(potential, equilibrium.x);
    solve.failure = failure_class(solve, record.stats.status, equilibrium.x.allFinite());
    solve.reason = solve.failure;
  });
  if (!exception.empty()) {
    solve.failure = "exception";
    solve.reason = exception;
  }
  record.type = solve.distribution;
  return solve;
}

Solves only(const Solves& solves, FabricDistribution distribution) {
  Solves some;
  for (const RobustnessSolve& solve : solves)
    if (solve.distribution == name(distribution)) some.push_back(solve);
  return some;
}

/// All drapes on one mesh. Their records go to results.h5 of the run's folder for the first size,
/// to that of a subfolder for the others. Empty after an interrupt.
Solves solve_all(const Settings& settings, const OutputFolder& folder, int size) {
  const std::vector<int> list = indices(settings.robustness);
  const auto count = static_cast<int>(list.size());
  const JsonStore store(folder, "solves");
  const auto item = [&](int i) { return item_name(size, list[static_cast<size_t>(i)]); };
  const bool first = size == settings.robustness.vertices.front();
  const std::filesystem::path part =
      first ? folder.path() : folder / ("vertices_" + std::to_string(size));
  if (!std::filesystem::exists(part / "results.h5")) {
    const auto discretization = make_discretization(settings, size);
    const RecordStore records(part, records_header(settings, discretization->mesh()), count);
    int resumed = 0;
    for (int i = 0; i < count; ++i) resumed += store.has(item(i));
    Progress progress("robustness, " + std::to_string(size) + " vertices", count, resumed);
    for_each_item(count, settings.experiment.thread_count(), [&](int i) {
      if (store.has(item(i))) return;
      Record record;
      const RobustnessSolve solved =
          solve(settings, discretization, size, list[static_cast<size_t>(i)], record);
      records.save(i, record);
      store.save(item(i), to_json(solved));
      progress.advance();
    });
    if (interrupted()) return {};
    records.consolidate();
  }
  Solves solves;
  for (int i = 0; i < count; ++i) solves.push_back(robustness_solve(store.load(item(i))));
  return solves;
}

}  // namespace

RunOutcome run_robustness(const Settings& settings, OutputFolder& folder) {
  using Json = nlohmann::ordered_json;
  Json per_size = Json::object();
  Solves all;
  std::printf("%s", table_head().c_str());
  for (int size : settings.robustness.vertices) {
    const Solves solves = solve_all(settings, folder, size);
    if (interrupted()) return {"partial", {}};
    for (FabricDistribution d : {FabricDistribution::measured, FabricDistribution::wide}) {
      const Solves some = only(solves, d);
      if (some.empty()) continue;
      const std::string label = std::to_string(size) + " " + std::string(name(d));
      std::printf("%s", table_row(label, account(some)).c_str());
    }
    per_size[std::to_string(size)] = account(solves);
    all.insert(all.end(), solves.begin(), solves.end());
  }

  RunOutcome outcome{"", account(all)};
  outcome.summary["failures"] = failures(all, folder.path());
  for (FabricDistribution d : {FabricDistribution::measured, FabricDistribution::wide})
    outcome.summary["distributions"][std::string(name(d))] = account(only(all, d));
  outcome.summary["per_size"] = per_size;
  const size_t failed = outcome.summary["failures"].size();
  outcome.status = failed == 0 ? "ok" : failed < all.size() ? "partial" : "failed";
  outcome.summary["targets_met"] = failed == 0;

  for (const Json& failure : outcome.summary["failures"])
    std::printf("fabric %d, %s, %d vertices: %s\n  %s\n", failure["index"].get<int>(),
                failure["distribution"].get<std::string>().c_str(), failure["vertices"].get<int>(),
                failure["reason"].get<std::string>().c_str(),
                failure["replay"].get<std::string>().c_str());
  std::printf("%s: certified minima with a residual within max(1e-8, rounding floor): %zu of %zu\n",
              failed == 0 ? "PASS" : "FAIL", all.size() - failed, all.size());
  write_text_durably(folder / "solves.csv", csv(all));
  std::fflush(stdout);  // the script prints as well
  draw_figure("robustness.py", folder / "solves.csv", folder / "units");
  return outcome;
}

}  // namespace drape
