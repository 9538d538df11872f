// Energy, gradient and Hessian of a drape: one evaluation each.
#include "benchmarks/drape_fixture.h"

namespace drape::bench {
namespace {

void assembly_energy(benchmark::State& state) {
  const Potential potential = medium_drape(vertices(state));
  const VecX x = folded_start(potential);
  for (auto _ : state) benchmark::DoNotOptimize(potential.energy(x));
}

void assembly_energy_and_gradient(benchmark::State& state) {
  const Potential potential = medium_drape(vertices(state));
  const VecX x = folded_start(potential);
  VecX gradient;
  for (auto _ : state) {
    benchmark::DoNotOptimize(potential.energy_and_gradient(x, gradient));
    benchmark::DoNotOptimize(gradient.data());
  }
}

void assembly_hessian(benchmark::State& state) {
  const Potential potential = medium_drape(vertices(state));
  const VecX x = folded_start(potential);
  SparseMatrix H = potential.discretization().hessian_pattern();
  for (auto _ : state) {
    potential.hessian(x, 0, H);
    benchmark::DoNotOptimize(H.valuePtr());
  }
  report(state, "nonzeros", static_cast<double>(H.nonZeros()));
}

BENCHMARK(assembly_energy)->Apply(every_size);
BENCHMARK(assembly_energy_and_gradient)->Apply(every_size);
BENCHMARK(assembly_hessian)->Apply(every_size);

}  // namespace
}  // namespace drape::bench
