// Numeric Cholesky factorisation of a drape's Hessian and one solve with it.
#include "benchmarks/drape_fixture.h"

namespace drape::bench {
namespace {

struct System {
  explicit System(const benchmark::State& state)
      : potential(medium_drape(vertices(state))),
        H(potential.discretization().hessian_pattern()),
        factor(potential.discretization().symbolic_factor()),
        x(factor.size()) {
    // the convex Hessian has a factor at any state; its pattern, and so the cost, are the same
    potential.hessian(folded_start(potential), 1, H);
    positive_definite = factor.factorize(H);
  }

  const Potential potential;
  SparseMatrix H;
  SparseFactor factor;
  VecX x;
  bool positive_definite = false;
};

void factorization_numeric(benchmark::State& state) {
  System system(state);
  if (!system.positive_definite) state.SkipWithError("the Hessian is not positive definite");
  for (auto _ : state) benchmark::DoNotOptimize(system.factor.factorize(system.H));
  report(state, "factor_nonzeros", system.potential.discretization().symbolic_factor()->nonzeros());
}

void factorization_solve(benchmark::State& state) {
  System system(state);
  if (!system.positive_definite) state.SkipWithError("the Hessian is not positive definite");
  for (auto _ : state) {
    system.x.setOnes();
    system.factor.solve_in_place(system.x);
    benchmark::DoNotOptimize(system.x.data());
  }
}

BENCHMARK(factorization_numeric)->Apply(every_size);
BENCHMARK(factorization_solve)->Apply(every_size);

}  // namespace
}  // namespace drape::bench
