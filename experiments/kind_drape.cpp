// kind = "drape": one fabric, one drape, everything that is known about it.
#include <cmath>
#include <optional>
#include <utility>

#include "experiments/ensemble_run.h"
#include "experiments/factorization_unit.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/record_store.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

Json percent(double fraction) { return std::isfinite(fraction) ? Json(100 * fraction) : Json(); }

/// What the summary says of a mesh chosen by mesh.vertices = "auto".
void write_resolution(Json& summary, const Resolution& resolution) {
  Json table = Json::array();
  double cpu = 0;
  for (const Rung& rung : resolution.rungs) {
    table.push_back({{"vertices", rung.vertices},
                     {"drape_coefficient_percent", percent(rung.drape_coefficient)},
                     {"node_count", rung.node_count},
                     {"same_branch", rung.same_branch},
                     {"estimated_error_points", percent(rung.estimate)},
                     {"scatter_points", percent(rung.scatter)},
                     {"other_mesh_same_branch", rung.other_mesh_same_branch},
                     {"cpu_seconds", rung.cpu_seconds}});
    cpu += rung.cpu_seconds;
  }
  const auto chosen = static_cast<size_t>(resolution.chosen);
  summary["resolution_status"] = name(resolution.status);
  summary["drape_coefficient_error_points"] =
      chosen < resolution.rungs.size() ? percent(resolution.rungs[chosen].error()) : Json();
  summary["resolution_cpu_seconds"] = cpu;
  summary["resolution"] = table;
}

struct DrapedOnce {
  Potential potential;
  ContactDrape drape;
  std::optional<Resolution> resolution;  ///< of mesh.vertices = "auto"
};

DrapedOnce drape_on_mesh(const Settings& settings) {
  if (settings.mesh.vertices) {
    Potential potential = make_potential(make_discretization(settings), settings.fabric, settings);
    ContactDrape drape = drape::drape(settings, potential);
    return {std::move(potential), std::move(drape), std::nullopt};
  }
  ResolvedDrape resolved = drape_resolved(settings);
  return {std::move(resolved.potential), std::move(resolved.drape), std::move(resolved.resolution)};
}

RunOutcome drape_once(const Settings& settings, OutputFolder& folder) {
  const DrapedOnce draped = drape_on_mesh(settings);
  const Potential& potential = draped.potential;
  const Equilibrium& equilibrium = draped.drape.equilibrium;
  const double unit = factorization_unit(potential, equilibrium.x);

  const RecordStore store(folder.path(), records_header(settings, potential.mesh()), 1);
  Record record = make_record(settings, potential, equilibrium);
  record.id = "1";
  store.save(0, record);
  store.consolidate();

  RunOutcome outcome{converged(record) ? "ok" : "failed", {}};
  Json& summary = outcome.summary;
  summary["solver_status"] = record.stats.status;
  summary["residual_relative"] = equilibrium.residual;
  summary["rounding_floor"] = potential.rounding_floor(equilibrium.x);
  summary["negative_eigenvalues"] = equilibrium.negative_eigenvalues;
  summary["smallest_eigenvalue"] =
      equilibrium.converged() ? Json(smallest_eigenvalue(equilibrium)) : nullptr;
  summary["newton_iterations"] = equilibrium.newton_iterations;
  summary["factorizations"] = equilibrium.factorizations;
  summary["vertices"] = potential.mesh().vertex_count();
  summary["energy"] = equilibrium.energy;
  summary["drape_coefficient_percent"] = 100 * record.observation.drape_coefficient;
  summary["node_count"] = record.observation.node_count;
  summary["drape_cpu_seconds"] = equilibrium.cpu_seconds;
  summary["factorization_equivalents"] = equilibrium.cpu_seconds / unit;
  summary["protocol"] = equilibrium.protocol;
  summary["wings_past_threshold"] = record.stats.wings_past_threshold;
  write_contact(summary, record.stats, draped.drape.contact.reason);
  if (draped.resolution) write_resolution(summary, *draped.resolution);
  return outcome;
}

}  // namespace

RunOutcome run_drape(const Settings& settings, OutputFolder& folder) {
  if (settings.start.protocol == StartProtocol::ensemble) return drape_ensemble(settings, folder);
  // One thread: the factorisation, nearly all of the work, gains nothing from a second one, and
  // waiting threads would count as CPU of the drape.
  RunOutcome outcome;
  for_each_item(1, 1, [&](int) { outcome = drape_once(settings, folder); });
  return outcome;
}

}  // namespace drape
