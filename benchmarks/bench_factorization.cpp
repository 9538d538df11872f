// Numeric Cholesky factorisation of the true Hessian of a drape and one solve with it.
#include <benchmark/benchmark.h>

#include "benchmarks/drape_fixture.h"

namespace drape::bench {
namespace {

struct System {
  explicit System(const benchmark::State& state)
      : drape(solved_drape(static_cast<int>(state.range(0)))),
        H(drape.potential.discretization().hessian_pattern()),
        factor(drape.potential.discretization().symbolic_factor()),
        right_hand_side(MatX::Ones(factor.size(), 1)) {
    drape.potential.hessian(drape.equilibrium.x, 0, H);
  }

  const SolvedDrape& drape;
  SparseMatrix H;
  SparseFactor factor;
  MatX right_hand_side;
};

void refuse_indefinite(benchmark::State& state, bool positive_definite) {
  if (!positive_definite) state.SkipWithError("the Hessian is not positive definite");
}

void factorization_numeric(benchmark::State& state) {
  System system(state);
  bool positive_definite = true;
  for (auto _ : state) positive_definite = positive_definite && system.factor.factorize(system.H);
  refuse_indefinite(state, positive_definite);
  state.counters["factor_nonzeros"] =
      system.drape.potential.discretization().symbolic_factor()->nonzeros();
}

void factorization_solve(benchmark::State& state) {
  System system(state);
  const bool positive_definite = system.factor.factorize(system.H);
  if (!positive_definite) return refuse_indefinite(state, false);
  for (auto _ : state) benchmark::DoNotOptimize(system.factor.solve(system.right_hand_side).data());
}

void factorization_both(benchmark::State& state) {
  System system(state);
  bool positive_definite = true;
  for (auto _ : state) {
    positive_definite = positive_definite && system.factor.factorize(system.H);
    if (!positive_definite) break;
    benchmark::DoNotOptimize(system.factor.solve(system.right_hand_side).data());
  }
  refuse_indefinite(state, positive_definite);
}

BENCHMARK(factorization_numeric)->Arg(1000)->Arg(2000)->Arg(8000)->Unit(benchmark::kMillisecond);
BENCHMARK(factorization_solve)->Arg(1000)->Arg(2000)->Arg(8000)->Unit(benchmark::kMillisecond);
BENCHMARK(factorization_both)->Arg(1000)->Arg(2000)->Arg(8000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace drape::bench
