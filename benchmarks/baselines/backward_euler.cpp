// Backward Euler solved by Newton's method with a line search: every time step minimises the
// incremental potential (Martin et al. 2011; Gast et al. 2015)
//
//   1/(2 h^2) (x - y)^T M (x - y) + E(x),  y = x_0 + h v,  then v = (x - x_0) / h,
//
// with the projected Hessian, to a hundredth of the static residual that it began with: the static
// residual of the rest state is what counts here. Of steps between 0.01 and 0.3 s the longest came
// to rest soonest: the scheme damps the motion, and in the limit it is the projected Newton method.
#include <cmath>

#include "benchmarks/baselines/lumped_mass.h"
#include "benchmarks/baselines/methods.h"
#include "core/sparse_factor.h"

namespace drape::baselines {
namespace {

constexpr double kStep = 0.3;            // h [s]
constexpr double kStepTolerance = 0.01;  // of a time step, over the static residual before it
constexpr double kArmijo = 1e-4;
constexpr double kRoundingSlack = 1e-13;  // of energy differences
constexpr double kShortest = 1e-9;        // step of a line search
constexpr double kLargestMove = 0.02;     // of a vertex in a Newton step [m]
constexpr int kMostIterations = 30;       // of Newton in a time step

}  // namespace

VecX backward_euler(const Potential& potential, VecX x, Course& course) {
  const Discretization& mesh = potential.discretization();
  const double h = course.time_step(kStep);
  const VecX inertia = lumped_masses(potential) / (h * h);
  const VecX free_inertia = mesh.to_free(inertia);
  SparseFactor factor(mesh.symbolic_factor());
  SparseMatrix H;
  VecX v = VecX::Zero(x.size()), gradient, trial_gradient;
  double energy = potential.energy_and_gradient(x, gradient);
  for (;;) {
    const VecX before = x, aim = x + h * v;
    const double tolerance = kStepTolerance * potential.residual(gradient);
    const auto kinetic = [&](const VecX& at) {
      return 0.5 * (at - aim).dot(inertia.cwiseProduct(at - aim));
    };
    for (int i = 0; i < kMostIterations; ++i) {
      const VecX force = mesh.to_free(gradient + inertia.cwiseProduct(x - aim));
      if (i > 0 && potential.residual(mesh.to_full(force)) <= tolerance) break;
      potential.hessian(x, 1, H);
      H.diagonal() += free_inertia;
      if (!factor.factorize(H)) return x;
      VecX d = -force;
      factor.solve_in_place(d);
      if (const double move = largest_move(d); move > kLargestMove) d *= kLargestMove / move;
      const double slope = force.dot(d), here = energy + kinetic(x);
      const double noise = kRoundingSlack * std::abs(here);
      const VecX full = mesh.to_full(d);
      double length = 1;
      VecX trial;
      for (;; length /= 2) {
        if (length < kShortest) return x;
        trial = x + length * full;
        energy = potential.energy_and_gradient(trial, trial_gradient);
        if (energy + kinetic(trial) <= here + kArmijo * length * slope + noise) break;
      }
      x = trial;
      gradient.swap(trial_gradient);
      if (!course.go_on(x, gradient)) return x;
    }
    v = (x - before) / h;
  }
}

}  // namespace drape::baselines
