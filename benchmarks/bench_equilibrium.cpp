// Whole solves: cold drapes by both protocols, and the drape of a fabric near by from a known one.
#include "benchmarks/drape_fixture.h"
#include "core/drape_protocol.h"

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

/// All bending stiffnesses changed by 3 %, as in a step of an estimation.
void drape_warm(benchmark::State& state) {
  const std::optional<SolvedDrape> drape = solved_drape(state);
  if (!drape) return;
  Fabric stiffer = drape->potential.fabric();
  for (Parameter p : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh}) stiffer[p] *= 1.03;
  Potential potential = drape->potential;
  potential.set_fabric(stiffer);
  Equilibrium equilibrium;
  for (auto _ : state)
    equilibrium = solve_equilibrium(potential, drape->equilibrium.x, {}, drape->equilibrium.factor);
  report_solve(state, potential, equilibrium);
}

BENCHMARK(drape_cold_folded)->Apply(every_size_once);
BENCHMARK(drape_cold_ramp)->Apply(every_size_once);
BENCHMARK(drape_warm)->Apply(every_size_once);

}  // namespace
}  // namespace drape::bench
