// The gradient that other differentiable cloth simulators take: back through every time step of a
// simulated motion (Gong et al. 2024, DiffCloth and others), here of implicit Euler
//
//   M (x_k+1 - 2 x_k + x_k-1) / h^2 + g(x_k+1; p) = 0,  x_-1 = x_0 at rest.
//
// Every step is solved by Newton's method to a small residual, so that its derivative follows from
// the implicit function theorem with the true Hessian at its end and no third derivatives occur.
// The backward pass is exact for the motion; what it misses of the drape's gradient is that the
// motion has not come to rest. It needs all states and a factorisation a step.
#pragma once

#include <vector>

#include "core/potential.h"

namespace drape::baselines {

class UnrolledDynamics {
 public:
  /// From x (3n) at rest; h: time step [s]. The potential is referred to and must live on.
  UnrolledDynamics(const Potential& potential, VecX x, double h);

  /// One time step. False if Newton's method does not solve it; the state is then not to be used.
  bool advance();

  const VecX& state() const { return states_.back(); }
  int steps() const { return static_cast<int>(states_.size()) - 1; }

  /// dL/dp for all parameters (natural units) from dL/dx of the last state (3n); x_0 is a constant.
  /// Throws std::runtime_error if the Hessian of a step is not positive definite.
  ParameterVector gradient(const VecX& dL_dx) const;

 private:
  const VecX& before(size_t step) const { return states_[step > 0 ? step - 1 : 0]; }

  const Potential& potential_;
  VecX inertia_;  // M / h^2 (3n) [N/m]
  std::vector<VecX> states_;
};

}  // namespace drape::baselines
