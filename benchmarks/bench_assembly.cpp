// Energy, gradient and Hessian of a drape: one evaluation each.
#include <benchmark/benchmark.h>

#include "benchmarks/drape_fixture.h"

namespace drape::bench {
namespace {

void assembly_energy(benchmark::State& state) {
  const SolvedDrape& drape = solved_drape(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(drape.potential.energy(drape.equilibrium.x));
}

void assembly_gradient(benchmark::State& state) {
  const SolvedDrape& drape = solved_drape(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(drape.potential.gradient(drape.equilibrium.x).data());
}

void assembly_hessian(benchmark::State& state) {
  const SolvedDrape& drape = solved_drape(static_cast<int>(state.range(0)));
  SparseMatrix H = drape.potential.discretization().hessian_pattern();
  for (auto _ : state) {
    drape.potential.hessian(drape.equilibrium.x, 0, H);
    benchmark::DoNotOptimize(H.valuePtr());
  }
  state.counters["nonzeros"] = static_cast<double>(H.nonZeros());
}

BENCHMARK(assembly_energy)->Arg(1000)->Arg(2000)->Arg(8000)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly_gradient)->Arg(1000)->Arg(2000)->Arg(8000)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly_hessian)->Arg(1000)->Arg(2000)->Arg(8000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace drape::bench
