// L-BFGS without a preconditioner (Liu and Nocedal 1989): the initial inverse is a multiple of the
// identity, s.y / y.y of the last step. Ten pairs, as in core, and Wolfe's line search.
#include <algorithm>

#include "benchmarks/baselines/line_search.h"
#include "benchmarks/baselines/lumped_mass.h"
#include "benchmarks/baselines/methods.h"
#include "core/limited_memory.h"

namespace drape::baselines {
namespace {

constexpr double kFlatness = 0.9;
constexpr double kFirstMove = 1e-4;    // of a vertex in the first step and after a restart [m]
constexpr double kLargestMove = 0.02;  // of a vertex in a step [m]

}  // namespace

VecX limited_memory_bfgs(const Potential& potential, VecX x, Course& course) {
  LimitedMemory memory(x.size());
  VecX gradient;
  double energy = potential.energy_and_gradient(x, gradient);
  double scale = kFirstMove / std::max(largest_move(gradient), 1e-300);
  for (bool restarted = true;;) {
    VecX d = -gradient;
    memory.apply(d, [&](VecX& q) { q *= scale; });
    if (const double move = largest_move(d); move > kLargestMove) d *= kLargestMove / move;
    LinePoint next = wolfe_point(potential, x, d, energy, gradient, 1, kFlatness);
    if (next.step == 0) {
      if (restarted) return x;
      memory.clear();
      scale = kFirstMove / largest_move(gradient);
      restarted = true;
      continue;
    }
    restarted = false;
    const VecX s = next.step * d, y = next.gradient - gradient;
    memory.push(s, y);
    if (s.dot(y) > 0) scale = s.dot(y) / y.squaredNorm();
    x = next.x;
    gradient = next.gradient;
    energy = next.energy;
    if (!course.go_on(x, gradient)) return x;
  }
}

}  // namespace drape::baselines
