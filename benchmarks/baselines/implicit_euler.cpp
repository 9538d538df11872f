// Implicit Euler as Baraff and Witkin (1998): one linear solve a step,
//
//   (M + h^2 H) dv = -h (g + h H v),  v <- v + dv,  x <- x + h v,
//
// with the Hessian projected as usual since Choi and Ko (2002), so that the matrix always has a
// Cholesky factor. As in their section 6, a step that changes the cloth too much is discarded and
// tried again with half of h, and h grows again after a few good ones. A large h approaches a
// Newton step without a line search. The motion has no damping but that of the scheme.
#include "benchmarks/baselines/lumped_mass.h"
#include "benchmarks/baselines/methods.h"
#include "core/sparse_factor.h"

namespace drape::baselines {
namespace {

constexpr double kFirstStep = 0.02, kLargestStep = 1;  // h [s]
constexpr double kShortestStep = 1e-7;                 // [s]
constexpr double kLargestMove = 0.02;                  // of a vertex in a step [m]
constexpr int kGoodSteps = 4;                          // before h is doubled

}  // namespace

VecX implicit_euler(const Potential& potential, VecX x, Course& course) {
  const Discretization& mesh = potential.discretization();
  const VecX mass = mesh.to_free(lumped_masses(potential));
  SparseFactor factor(mesh.symbolic_factor());
  SparseMatrix H;
  VecX gradient, v = VecX::Zero(mass.size());
  potential.energy_and_gradient(x, gradient);
  int good = 0;
  for (double h = course.time_step(kFirstStep); h > kShortestStep;) {
    potential.hessian(x, 1, H);
    const VecX change = H.selfadjointView<Eigen::Lower>() * v;
    VecX dv = -h * (mesh.to_free(gradient) + h * change);
    H *= h * h;
    H.diagonal() += mass;
    const bool solved = factor.factorize(H);
    if (!solved && !course.own_time_step()) return x;
    if (solved) factor.solve_in_place(dv);
    const bool discarded =
        course.own_time_step() && (!solved || !(h * largest_move(v + dv) < kLargestMove));
    if (!discarded) {
      v += dv;
      x += mesh.to_full(h * v);
      potential.energy_and_gradient(x, gradient);
    }
    if (!course.go_on(x, gradient)) return x;
    if (!course.own_time_step()) continue;
    if (discarded) {
      h /= 2;
      good = 0;
    } else if (++good >= kGoodSteps && h < kLargestStep) {
      h *= 2;
      good = 0;
    }
  }
  return x;
}

}  // namespace drape::baselines
