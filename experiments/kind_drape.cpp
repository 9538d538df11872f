// kind = "drape": one fabric, one drape, everything that is known about it.
#include "experiments/ensemble_run.h"
#include "experiments/factorization_unit.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/record_store.h"

namespace drape {
namespace {

RunOutcome drape_once(const Settings& settings, OutputFolder& folder) {
  const auto discretization = make_discretization(settings);
  Potential potential = make_potential(discretization, settings.fabric, settings);
  const ContactDrape draped = drape(settings, potential);
  const Equilibrium& equilibrium = draped.equilibrium;
  const double unit = factorization_unit(potential, equilibrium.x);

  const RecordStore store(folder.path(), records_header(settings, potential.mesh()), 1);
  Record record = make_record(settings, potential, equilibrium);
  record.id = "1";
  store.save(0, record);
  store.consolidate();

  RunOutcome outcome{converged(record) ? "ok" : "failed", {}};
  nlohmann::ordered_json& summary = outcome.summary;
  summary["solver_status"] = record.stats.status;
  summary["residual_relative"] = equilibrium.residual;
  summary["rounding_floor"] = potential.rounding_floor(equilibrium.x);
  summary["negative_eigenvalues"] = equilibrium.negative_eigenvalues;
  summary["smallest_eigenvalue"] =
      equilibrium.converged() ? nlohmann::ordered_json(smallest_eigenvalue(equilibrium)) : nullptr;
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
  write_contact(summary, record.stats, draped.contact.reason);
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
