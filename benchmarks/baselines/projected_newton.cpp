// Newton's method with a Hessian that is always projected, H(1) of core: every step leads down and
// Armijo backtracking accepts it. A drape at rest keeps compressed elements, so that the projection
// stays on and the convergence is linear.
#include <cmath>

#include "benchmarks/baselines/lumped_mass.h"
#include "benchmarks/baselines/methods.h"
#include "core/sparse_factor.h"

namespace drape::baselines {
namespace {

constexpr double kArmijo = 1e-4;
constexpr double kRoundingSlack = 1e-13;  // of energies
constexpr double kShortest = 1e-9;        // step of a line search
constexpr double kLargestMove = 0.02;     // of a vertex in a step [m]

}  // namespace

VecX projected_newton(const Potential& potential, VecX x, Course& course) {
  const Discretization& mesh = potential.discretization();
  SparseFactor factor(mesh.symbolic_factor());
  SparseMatrix H;
  VecX gradient, trial, trial_gradient;
  double energy = potential.energy_and_gradient(x, gradient);
  for (;;) {
    potential.hessian(x, 1, H);
    if (!factor.factorize(H)) return x;
    VecX d = -mesh.to_free(gradient);
    factor.solve_in_place(d);
    if (const double move = largest_move(d); move > kLargestMove) d *= kLargestMove / move;
    const VecX full = mesh.to_full(d);
    const double slope = gradient.dot(full), noise = kRoundingSlack * std::abs(energy);
    double length = 1, there = 0;
    for (;; length /= 2) {
      if (length < kShortest) return x;
      trial = x + length * full;
      there = potential.energy_and_gradient(trial, trial_gradient);
      if (there <= energy + kArmijo * length * slope + noise) break;
    }
    x.swap(trial);
    gradient.swap(trial_gradient);
    energy = there;
    if (!course.go_on(x, gradient)) return x;
  }
}

}  // namespace drape::baselines
