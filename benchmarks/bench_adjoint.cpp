// Derivatives of a drape, given the factor that its equilibrium carries: the adjoint gradient of a
// scalar for all thirteen parameters, and the tangent: sensitivities of the whole state.
#include <vector>

#include "adjoint/adjoint.h"
#include "adjoint/sensitivity.h"
#include "benchmarks/drape_fixture.h"
#include "core/cpu_clock.h"

namespace drape::bench {
namespace {

void report_share(benchmark::State& state, const SolvedDrape& drape, double begin) {
  const double cpu = thread_cpu_seconds() - begin;
  report_units(state, drape.potential, drape.equilibrium.x,
               cpu / static_cast<double>(state.iterations()));
}

void adjoint_gradient_of_area(benchmark::State& state) {
  const std::optional<SolvedDrape> drape = solved_drape(state);
  if (!drape) return;
  const VecX dA_dx =
      pull_back(drape->outline, drape->equilibrium.x, area_gradient(drape->outline.points));
  const double begin = thread_cpu_seconds();
  for (auto _ : state)
    benchmark::DoNotOptimize(adjoint_gradient(drape->potential, drape->equilibrium, dA_dx).data());
  report_share(state, *drape, begin);
}

void tangent(benchmark::State& state, const std::vector<Parameter>& parameters) {
  const std::optional<SolvedDrape> drape = solved_drape(state);
  if (!drape) return;
  const double begin = thread_cpu_seconds();
  for (auto _ : state)
    benchmark::DoNotOptimize(
        sensitivities(drape->potential, drape->equilibrium, parameters).data());
  report_share(state, *drape, begin);
}

/// The parameters that an outline tells.
void tangent_of_4_parameters(benchmark::State& state) {
  tangent(state, {Parameter::k_h, Parameter::k_bu, Parameter::k_bv, Parameter::k_bh});
}

void tangent_of_13_parameters(benchmark::State& state) {
  tangent(state, {all_parameters().begin(), all_parameters().end()});
}

BENCHMARK(adjoint_gradient_of_area)->Apply(every_size);
BENCHMARK(tangent_of_4_parameters)->Apply(every_size);
BENCHMARK(tangent_of_13_parameters)->Apply(every_size);

}  // namespace
}  // namespace drape::bench
