// Nonlinear conjugate gradients, PR+ (Gilbert and Nocedal 1992):
//
//   beta = max(0, g.(g - g_0) / g_0.g_0),  d <- -g + beta d,
//
// with Wolfe's line search and a restart along -g where d does not lead down. The search is a tight
// one: with a flatness of 0.1 instead of 0.02 the directions lost their conjugacy and the residual
// stalled near 1e-3.
#include <algorithm>

#include "benchmarks/baselines/line_search.h"
#include "benchmarks/baselines/lumped_mass.h"
#include "benchmarks/baselines/methods.h"

namespace drape::baselines {
namespace {

constexpr double kFlatness = 0.02;
constexpr double kFirstMove = 1e-4;    // of a vertex in the first step and after a restart [m]
constexpr double kLargestMove = 0.02;  // of a vertex in the step tried first [m]

}  // namespace

VecX conjugate_gradients(const Potential& potential, VecX x, Course& course) {
  VecX gradient;
  double energy = potential.energy_and_gradient(x, gradient);
  VecX d = -gradient;
  double step = kFirstMove / std::max(largest_move(gradient), 1e-300);
  for (bool restarted = true;;) {
    step = std::min(step, kLargestMove / largest_move(d));
    const LinePoint next = wolfe_point(potential, x, d, energy, gradient, step, kFlatness);
    if (next.step == 0) {
      if (restarted) return x;
      d = -gradient;
      step = kFirstMove / largest_move(gradient);
      restarted = true;
      continue;
    }
    restarted = false;
    const double beta =
        std::max(0.0, next.gradient.dot(next.gradient - gradient) / gradient.squaredNorm());
    const double slope = gradient.dot(d);
    d = beta * d - next.gradient;
    x = next.x;
    gradient = next.gradient;
    energy = next.energy;
    if (!course.go_on(x, gradient)) return x;
    if (!(gradient.dot(d) < 0)) d = -gradient;
    step = next.step * slope / gradient.dot(d);  // the same first-order change as last time
  }
}

}  // namespace drape::baselines
