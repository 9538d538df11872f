// Derivatives of a drape, given the factor that its equilibrium carries: the adjoint gradient of a
// scalar for all thirteen parameters, and forward sensitivities of the whole state.
#include <benchmark/benchmark.h>

#include <vector>

#include "adjoint/adjoint.h"
#include "adjoint/sensitivity.h"
#include "benchmarks/drape_fixture.h"

namespace drape::bench {
namespace {

void adjoint_of_the_shadow_area(benchmark::State& state) {
  const SolvedDrape& drape = solved_drape(static_cast<int>(state.range(0)));
  const VecX dA_dx =
      pull_back(drape.outline, drape.equilibrium.x, area_gradient(drape.outline.points));
  for (auto _ : state)
    benchmark::DoNotOptimize(adjoint_gradient(drape.potential, drape.equilibrium, dA_dx).data());
}

/// Arguments: vertices, number of parameters.
void sensitivities_of_the_state(benchmark::State& state) {
  const SolvedDrape& drape = solved_drape(static_cast<int>(state.range(0)));
  const std::vector<Parameter> parameters =
      state.range(1) == kParameterCount
          ? std::vector<Parameter>(all_parameters().begin(), all_parameters().end())
          : std::vector<Parameter>{Parameter::k_h, Parameter::k_bu, Parameter::k_bv,
                                   Parameter::k_bh};
  for (auto _ : state)
    benchmark::DoNotOptimize(sensitivities(drape.potential, drape.equilibrium, parameters).data());
}

BENCHMARK(adjoint_of_the_shadow_area)
    ->Arg(1000)
    ->Arg(2000)
    ->Arg(8000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(sensitivities_of_the_state)
    ->ArgsProduct({{1000, 2000, 8000}, {4, kParameterCount}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace drape::bench
