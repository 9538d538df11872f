#include "experiments/factorization_unit.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "core/cpu_clock.h"
#include "core/sparse_factor.h"

namespace drape {
namespace {

constexpr int kRepetitions = 5;
constexpr double kBlend =
    1;  // the projected Hessian has a factor at any state; its cost is the same

}  // namespace

double factorization_unit(const Potential& potential, const VecX& x) {
  const Discretization& discretization = potential.discretization();
  auto symbolic = discretization.symbolic_factor();
  if (symbolic->backend() != default_factor_backend())
    symbolic = std::make_shared<const SymbolicFactor>(discretization.hessian_pattern(),
                                                      default_factor_backend());
  SparseFactor factor(symbolic);
  SparseMatrix H;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRepetitions; ++i) {
    const double start = thread_cpu_seconds();
    potential.hessian(x, kBlend, H);
    factor.factorize(H);
    best = std::min(best, thread_cpu_seconds() - start);
  }
  return best;
}

}  // namespace drape
