// Whole solves: a drape from a folded start, and the drape of a fabric near by from a known one.
#include <benchmark/benchmark.h>

#include "benchmarks/drape_fixture.h"

namespace drape::bench {
namespace {

void report(benchmark::State& state, const Equilibrium& equilibrium) {
  if (!equilibrium.converged()) state.SkipWithError("the drape did not converge");
  state.counters["newton_iterations"] = equilibrium.newton_iterations;
  state.counters["factorizations"] = equilibrium.factorizations;
}

void equilibrium_cold(benchmark::State& state) {
  const Potential potential(disc(static_cast<int>(state.range(0))), medium_fabric(), {},
                            kScene.gravity);
  Equilibrium equilibrium;
  for (auto _ : state) equilibrium = drape_by_lobes(potential, kScene, kLobes, 0.1);
  report(state, equilibrium);
}

/// All bending stiffnesses changed by 3 %, as in a step of an estimation.
void equilibrium_warm(benchmark::State& state) {
  const SolvedDrape& drape = solved_drape(static_cast<int>(state.range(0)));
  Fabric stiffer = drape.potential.fabric();
  for (Parameter p : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh}) stiffer[p] *= 1.03;
  Potential potential = drape.potential;
  potential.set_fabric(stiffer);
  Equilibrium equilibrium;
  for (auto _ : state) equilibrium = solve_equilibrium(potential, drape.equilibrium.x);
  report(state, equilibrium);
}

BENCHMARK(equilibrium_cold)->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);
BENCHMARK(equilibrium_warm)->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace drape::bench
