#include "experiments/ensemble_run.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/factorization_unit.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/record_store.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

/// The drapes of all starts: durable records in `starts/`, and what only a factor tells beside
/// them.
struct Drapes {
  std::vector<Record> records;
  std::vector<Json> numbers;  ///< smallest eigenvalue, rounding floor, reason of the contact
};

Json solve_start(const Settings& settings, Potential potential, const EnsembleStart& start,
                 Record& record) {
  Json numbers = Json::object();
  try {
    const ContactDrape draped = drape(settings, potential, [&](const Potential& of) {
      return drape_from(of, settings.scene, start, equilibrium_options(settings));
    });
    const Equilibrium& equilibrium = draped.equilibrium;
    record = make_record(settings, potential, equilibrium);
    numbers["contact_reason"] = draped.contact.reason;
    numbers["rounding_floor"] = potential.rounding_floor(equilibrium.x);
    if (equilibrium.converged()) numbers["smallest_eigenvalue"] = smallest_eigenvalue(equilibrium);
  } catch (const std::exception& error) {
    record = failed_record(settings, potential.mesh(), potential.fabric(), error.what());
  }
  record.id = record.name = record.stats.protocol = start.name();
  return numbers;
}

Drapes drape_all(const Settings& settings, const OutputFolder& folder, const Potential& potential,
                 const std::vector<EnsembleStart>& starts) {
  const int count = static_cast<int>(starts.size());
  const RecordStore records(folder / "starts", records_header(settings, potential.mesh()), count);
  const JsonStore numbers(folder, "starts");
  Progress progress("ensemble", count, records.finished());
  for_each_item(count, settings.experiment.thread_count(), [&](int i) {
    if (records.has(i)) return;
    Record record;
    const Json more = solve_start(settings, potential, starts[static_cast<size_t>(i)], record);
    numbers.save(std::to_string(i), more);
    records.save(i, record);
    if (!converged(record)) progress.note(record.id + ": " + record.stats.status);
    progress.advance();
  });
  Drapes drapes;
  if (interrupted()) return drapes;
  drapes.records = records.load_all();
  for (int i = 0; i < count; ++i) drapes.numbers.push_back(numbers.load(std::to_string(i)));
  return drapes;
}

Json minimum_entry(const Drapes& drapes, const std::vector<size_t>& converged_starts,
                   const MinimumGroup& group) {
  const size_t i = converged_starts[group.representative];
  const Record& record = drapes.records[i];
  Json found = Json::array();
  for (size_t member : group.members) found.push_back(drapes.records[converged_starts[member]].id);
  return {{"energy", record.stats.energy},
          {"drape_coefficient_percent", 100 * record.observation.drape_coefficient},
          {"node_count", record.observation.node_count},
          {"smallest_eigenvalue", drapes.numbers[i]["smallest_eigenvalue"]},
          {"times_found", group.members.size()},
          {"found_from", found}};
}

}  // namespace

RunOutcome drape_ensemble(const Settings& settings, OutputFolder& folder) {
  const std::vector<EnsembleStart> starts = ensemble_starts(ensemble_options(settings));
  const auto discretization = make_discretization(settings);
  const Potential potential = make_potential(discretization, settings.fabric, settings);
  const Drapes drapes = drape_all(settings, folder, potential, starts);
  if (interrupted()) return {"partial", {}};

  std::vector<size_t> good;
  std::vector<VecX> states;
  std::vector<double> energies;
  double cpu = 0;
  int iterations = 0, factorizations = 0;
  for (size_t i = 0; i < drapes.records.size(); ++i) {
    const Record& record = drapes.records[i];
    cpu += record.stats.cpu_seconds;
    iterations += record.stats.newton_iterations;
    factorizations += record.stats.factorizations;
    if (!converged(record)) continue;
    good.push_back(i);
    states.push_back(record.positions);
    energies.push_back(record.stats.energy);
  }
  RunOutcome outcome{good.size() == starts.size() ? "ok" : good.empty() ? "failed" : "partial", {}};
  Json& summary = outcome.summary;
  summary["starts"] = starts.size();
  summary["failed_starts"] = starts.size() - good.size();
  summary["protocol"] = "ensemble";
  summary["vertices"] = potential.mesh().vertex_count();
  if (good.empty()) return outcome;

  const std::vector<MinimumGroup> groups =
      merge_minima(states, energies, settings.start.ensemble.same_distance);
  Json minima = Json::array();
  std::vector<Record> records;
  std::vector<VecX> profiles;
  std::vector<double> coefficients;
  for (const MinimumGroup& group : groups) {
    minima.push_back(minimum_entry(drapes, good, group));
    Record record = drapes.records[good[group.representative]];
    record.id = std::to_string(records.size() + 1);
    record.name.clear();  // all starts that ended here
    for (size_t member : group.members)
      record.name += (record.name.empty() ? "" : "; ") + drapes.records[good[member]].id;
    profiles.push_back(record.observation.profile);
    coefficients.push_back(100 * record.observation.drape_coefficient);
    records.push_back(std::move(record));
  }
  const auto [low, high] = std::ranges::minmax(coefficients);
  const size_t lowest = good[groups.front().representative];
  const Record& reported = records.front();
  summary["lowest_from"] = drapes.records[lowest].id;
  summary["drape_coefficient_interval_percent"] = {low, high};
  summary["distinct_minima"] = groups.size();
  summary["distinct_shapes"] = distinct_shapes(profiles, settings.fabric);
  summary["solver_status"] = reported.stats.status;
  summary["residual_relative"] = reported.stats.residual_relative;
  summary["rounding_floor"] = drapes.numbers[lowest]["rounding_floor"];
  summary["negative_eigenvalues"] = reported.stats.negative_eigenvalues;
  summary["smallest_eigenvalue"] = minima[0]["smallest_eigenvalue"];
  summary["newton_iterations"] = iterations;
  summary["factorizations"] = factorizations;
  summary["energy"] = reported.stats.energy;
  summary["drape_coefficient_percent"] = minima[0]["drape_coefficient_percent"];
  summary["node_count"] = reported.observation.node_count;
  summary["drape_cpu_seconds"] = cpu;
  double unit = 0;
  for_each_item(1, 1, [&](int) { unit = factorization_unit(potential, reported.positions); });
  summary["factorization_equivalents"] = cpu / unit;
  summary["wings_past_threshold"] = reported.stats.wings_past_threshold;
  write_contact(summary, reported.stats, drapes.numbers[lowest]["contact_reason"]);
  summary["minima"] = minima;

  write_records(folder / "results.h5", records_header(settings, potential.mesh()), records);
  std::filesystem::remove_all(folder / "starts");
  draw_figure("ensemble.py", folder / "results.h5", folder / "ensemble");
  return outcome;
}

}  // namespace drape
