// Following one branch of equilibria as the fabric changes.
//
// A drape has many equilibria, and a loss is differentiable along one of them only. The fabric goes
// along the straight line between two vectors of unknowns, the drape along its branch (branch.h); a
// branch that snaps on the way is lost.
#pragma once

#include <optional>

#include "adjoint/branch.h"
#include "core/equilibrium.h"
#include "core/potential.h"
#include "estimation/parameter_space.h"

namespace drape {

/// A converged equilibrium together with what is needed to leave it.
struct BranchPoint {
  VecX z;                   ///< unknowns (see ParameterSpace)
  Equilibrium equilibrium;  ///< converged
  MatX dx_dz;               ///< 3n x size
};

struct ContinuationOptions {
  double largest_step = 0.35;       ///< largest change of an unknown in one step
  double largest_deviation = 0.35;  ///< of the minimum from the prediction, over predicted movement
  double noise = 2e-5;              ///< deviations below this are never a snap [m]
  int halvings = 7;                 ///< how often a step is halved before the branch counts as lost
  double largest_leap = 10;         ///< a path with a larger change of an unknown is not tried
  EquilibriumOptions equilibrium{.tolerance = 1e-8, .max_iterations = 600};
};

/// The sensitivities of a converged equilibrium make it a point to continue from.
BranchPoint make_branch_point(const Potential& potential, const ParameterSpace& space,
                              const VecX& z, Equilibrium equilibrium);

/// Follows the branch from `from` to z. `potential` (guide and gravity as set) ends with the fabric
/// of the last state tried. Nothing when the branch was lost.
std::optional<BranchPoint> follow_branch(Potential& potential, const ParameterSpace& space,
                                         const BranchPoint& from, const VecX& z,
                                         const ContinuationOptions& options,
                                         ContinuationCost* cost = nullptr);

}  // namespace drape
