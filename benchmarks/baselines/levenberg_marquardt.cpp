// Levenberg-Marquardt on the full Hessian: the step solves (H + mu D) d = -g, D the moduli of the
// diagonal of H. mu grows where that matrix has no Cholesky factor and where the energy falls by
// less than the quadratic model says, and shrinks where they agree (Moré 1978; Nocedal and Wright,
// section 4.1): near a minimum it is Newton's method.
#include <algorithm>
#include <cmath>

#include "benchmarks/baselines/lumped_mass.h"
#include "benchmarks/baselines/methods.h"
#include "core/sparse_factor.h"

namespace drape::baselines {
namespace {

constexpr double kFirst = 1e-2, kSmallest = 1e-12, kLargest = 1e12;  // mu
constexpr double kLeastGain = 1e-4, kPoorGain = 0.25, kGoodGain = 0.75;
constexpr double kGrowth = 4, kShrinkage = 0.2;
constexpr double kRoundingSlack = 1e-13;  // of energies
constexpr double kLargestMove = 0.02;     // of a vertex in a step [m]

}  // namespace

VecX levenberg_marquardt(const Potential& potential, VecX x, Course& course) {
  const Discretization& mesh = potential.discretization();
  SparseFactor factor(mesh.symbolic_factor());
  SparseMatrix H, damped;
  VecX gradient, trial_gradient;
  double energy = potential.energy_and_gradient(x, gradient);
  potential.hessian(x, 0, H);
  for (double mu = kFirst; mu < kLargest;) {
    damped = H;
    damped.diagonal() += mu * H.diagonal().cwiseAbs();
    bool accepted = false;
    if (factor.factorize(damped)) {
      const VecX g = mesh.to_free(gradient);
      VecX d = -g;
      factor.solve_in_place(d);
      if (largest_move(d) <= kLargestMove) {
        const double expected = -g.dot(d) - 0.5 * d.dot(H.selfadjointView<Eigen::Lower>() * d);
        const VecX trial = x + mesh.to_full(d);
        const double there = potential.energy_and_gradient(trial, trial_gradient);
        const double noise = kRoundingSlack * std::abs(energy);
        // below rounding the slope decides
        const double gain = expected > noise ? (energy - there) / expected
                            : potential.residual(trial_gradient) < potential.residual(gradient) ? 1
                                                                                                : 0;
        accepted = std::isfinite(there) && gain > kLeastGain;
        if (accepted) {
          x = trial;
          gradient.swap(trial_gradient);
          energy = there;
          if (gain > kGoodGain) mu = std::max(kSmallest, mu * kShrinkage);
          if (gain < kPoorGain) mu *= kGrowth;
        }
      }
    }
    if (!accepted) mu *= kGrowth;
    if (!course.go_on(x, gradient)) return x;
    if (accepted) potential.hessian(x, 0, H);
  }
  return x;
}

}  // namespace drape::baselines
