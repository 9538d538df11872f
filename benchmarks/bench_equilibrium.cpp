// Whole solves: cold drapes by both protocols, and the drape of a fabric near by from a known one.
#include <algorithm>
#include <cmath>
#include <vector>

#include "adjoint/branch.h"
#include "benchmarks/drape_fixture.h"
#include "core/contact.h"
#include "core/drape_protocol.h"
#include "experiments/fabric_distribution.h"
#include "experiments/factorization_unit.h"
#include "experiments/statistics.h"

namespace drape::bench {
namespace {

void report_solve(benchmark::State& state, const Potential& potential,
                  const Equilibrium& equilibrium) {
  if (!equilibrium.converged()) state.SkipWithError("the drape did not converge");
  report(state, "newton_iterations", equilibrium.newton_iterations);
  report(state, "factorizations", equilibrium.factorizations);
  report_units(state, potential, equilibrium.x, equilibrium.cpu_seconds);
}

void drape_cold_folded(benchmark::State& state) {
  const Potential potential = medium_drape(vertices(state));
  Equilibrium equilibrium;
  for (auto _ : state) equilibrium = drape_by_lobes(potential, kCusick, kLobes, kPhase);
  report_solve(state, potential, equilibrium);
}

void drape_cold_ramp(benchmark::State& state) {
  const Potential potential = medium_drape(vertices(state));
  Equilibrium equilibrium;
  for (auto _ : state) equilibrium = drape_by_coarse_ramp(potential, 1);
  report_solve(state, potential, equilibrium);
}

/// A drape at rest and the fabric next to it, all bending stiffnesses 3 % up or down, as in a step
/// of an estimation.
struct Step {
  Potential potential;  ///< with the changed fabric
  Equilibrium from;
  VecX predicted;  ///< by the tangent, 3n
};

constexpr int kVertices = 20000;  // of all drapes together: 20 fabrics at 1000, 10 at 2000

std::vector<Step> steps_of_random_fabrics(const Potential& medium) {
  std::vector<Step> steps;
  const int fabrics = std::max(1, kVertices / medium.mesh().vertex_count());
  for (int i = 0; i < fabrics; ++i) {
    Random random(seed_of_item(1, static_cast<std::uint64_t>(i)));
    Potential potential = medium;
    potential.set_fabric(random_fabric(random, FabricDistribution::measured));
    Equilibrium from =
        drape_with_contact(potential, kCusick, ContactMode::automatic, [](const Potential& of) {
          return drape_by_lobes(of, kCusick, kLobes, kPhase);
        }).equilibrium;
    if (!from.converged()) continue;
    const FabricPath path =
        scaled_path(potential.fabric(), {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh});
    const BranchState at = make_branch_state(potential, path, 0, std::move(from));
    for (const double s : {std::log(1.03), -std::log(1.03)}) {
      steps.push_back({potential, at.equilibrium, at.equilibrium.x + s * at.dx_ds});
      steps.back().potential.set_fabric(path.fabric(s));
    }
  }
  return steps;
}

/// Whether the drape left its branch, by the rule of branch.h.
bool snapped(const Step& step, const VecX& x) {
  return largest_distance(x, step.predicted) > allowed_deviation({}, step.predicted, step.from.x);
}

/// Re-solves from the state and the factor of the drape near by; a snap is another task, and is
/// counted apart.
void drape_warm(benchmark::State& state) {
  const Potential medium = medium_drape(vertices(state));
  const std::vector<Step> steps = steps_of_random_fabrics(medium);
  std::vector<Equilibrium> drapes;
  for (auto _ : state)
    for (const Step& step : steps)
      drapes.push_back(solve_equilibrium(step.potential, step.from.x, {}, step.from.factor));
  const double unit = factorization_unit(medium, folded_start(medium));
  std::vector<double> units, units_of_snaps;
  for (size_t i = 0; i < steps.size(); ++i) {
    if (!drapes[i].converged()) state.SkipWithError("a drape did not converge");
    (snapped(steps[i], drapes[i].x) ? units_of_snaps : units)
        .push_back(drapes[i].cpu_seconds / unit);
  }
  report(state, "steps", static_cast<double>(steps.size()));
  report(state, "snaps", static_cast<double>(units_of_snaps.size()));
  if (!units.empty()) {
    report(state, "units", percentile(units, 50));
    report(state, "units_95", percentile(units, 95));
  }
  if (!units_of_snaps.empty()) report(state, "units_of_snaps", percentile(units_of_snaps, 50));
  report(state, "unit_ms", 1e3 * unit);
}

BENCHMARK(drape_cold_folded)->Apply(every_size_once);
BENCHMARK(drape_cold_ramp)->Apply(every_size_once);
BENCHMARK(drape_warm)->Apply(every_size_once);

}  // namespace
}  // namespace drape::bench
