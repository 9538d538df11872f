// A line search for methods that need a step with the curvature condition: L-BFGS and nonlinear
// conjugate gradients.
//
// Wolfe's conditions, strong in the slope, found by bracketing and secant steps on the slope. Near
// a minimum differences of the energy drown in rounding; there, as Hager and Zhang (2005), an
// energy that is not above the start's by more than rounding is accepted if the slope is.
#pragma once

#include "core/potential.h"

namespace drape::baselines {

/// A point on the line; `step` is 0 where none was found.
struct LinePoint {
  double step = 0, energy = 0;
  VecX x, gradient;  // 3n
};

/// From x along d (3n), with the energy and gradient at x. first: the step tried first. flatness:
/// the slope at the end, over that at the start. The step is 0 where d does not lead down or no
/// acceptable point was found.
LinePoint wolfe_point(const Potential& potential, const VecX& x, const VecX& d, double energy,
                      const VecX& gradient, double first, double flatness);

}  // namespace drape::baselines
