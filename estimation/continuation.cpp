#include "estimation/continuation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "adjoint/sensitivity.h"

namespace drape {
namespace {

double largest_norm(const VecX& displacement) {
  return displacement.reshaped(3, displacement.size() / 3).colwise().norm().maxCoeff();
}

/// One predicted and corrected step; nothing if it left the branch.
std::optional<BranchPoint> step_to(Potential& potential, const ParameterSpace& space,
                                   const BranchPoint& from, const VecX& z,
                                   const ContinuationOptions& options, ContinuationCost& cost) {
  potential.set_fabric(space.decode(z));
  const VecX predicted = from.dx_dz * (z - from.z);
  const VecX start = from.equilibrium.x + predicted;
  Equilibrium equilibrium = solve_equilibrium(potential, start, options.equilibrium);
  ++cost.solves;
  cost.newton_iterations += equilibrium.newton_iterations;
  cost.factorizations += equilibrium.factorizations;
  if (!equilibrium.converged()) return std::nullopt;
  const double allowed =
      std::max(options.noise, options.largest_deviation * largest_norm(predicted));
  if (largest_distance(equilibrium.x, start) > allowed) return std::nullopt;
  equilibrium.protocol = from.equilibrium.protocol;
  return make_branch_point(potential, space, z, std::move(equilibrium));
}

}  // namespace

double largest_distance(const VecX& a, const VecX& b) { return largest_norm(a - b); }

BranchPoint make_branch_point(const Potential& potential, const ParameterSpace& space,
                              const VecX& z, Equilibrium equilibrium) {
  MatX dx_dz =
      sensitivities(potential, equilibrium, space.parameters) * space.derivative(z).asDiagonal();
  return {z, std::move(equilibrium), std::move(dx_dz)};
}

std::optional<BranchPoint> follow_branch(Potential& potential, const ParameterSpace& space,
                                         const BranchPoint& from, const VecX& z,
                                         const ContinuationOptions& options,
                                         ContinuationCost* cost) {
  ContinuationCost ignored;
  ContinuationCost& work = cost != nullptr ? *cost : ignored;
  const VecX path = z - from.z;
  const double length = path.cwiseAbs().maxCoeff();
  if (length > options.largest_leap) return std::nullopt;
  const double smallest = std::pow(0.5, options.halvings);

  BranchPoint point = from;
  double done = 0, step = length > 0 ? std::min(1.0, options.largest_step / length) : 1.0;
  while (done < 1) {
    const double next = done + step > 1 - 1e-12 ? 1 : done + step;
    const VecX target = next == 1 ? z : VecX(from.z + next * path);
    auto reached = step_to(potential, space, point, target, options, work);
    if (reached) {
      point = *std::move(reached);
      done = next;
      step = std::min(2 * step, length > 0 ? options.largest_step / length : 1.0);
    } else {
      step /= 2;
      if (step < smallest) return std::nullopt;
    }
  }
  return point;
}

}  // namespace drape
