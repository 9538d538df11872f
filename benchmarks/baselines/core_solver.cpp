// core's solver (equilibrium.h) from the same start as the others: no protocol, no coarse mesh. It
// goes on past a small residual until it has certified a minimum, and is charged for that.
#include "benchmarks/baselines/methods.h"
#include "core/equilibrium.h"

namespace drape::baselines {

VecX core_solver(const Potential& potential, VecX x, Course& course) {
  EquilibriumOptions options;
  options.tolerance = course.tolerance();
  options.max_iterations = 1'000'000'000;
  options.go_on = [&](const VecX& state, const VecX& gradient) {
    return course.go_on(state, gradient) || course.within_tolerance();
  };
  return solve_equilibrium(potential, x, options).x;
}

}  // namespace drape::baselines
