// What a branch of minima does where natural steps lose it, and the snap that follows.
//
// Pseudo-arclength continuation (Keller 1977): state and parameter together, y = (x, s), advance
// along the tangent t of the solution curve; each step solves g(x, s) = 0 and t.(y - y_predicted) =
// 0 by Newton's method, whose bordered matrix stays regular where H is singular. At a limit point
// (fold) ds/d(arclength) changes sign and one eigenvalue of H becomes negative: there the minimum
// meets a saddle and both end. The state then falls to another minimum: a snap.
#pragma once

#include <string_view>

#include "adjoint/branch.h"

namespace drape {

enum class BranchEnd {
  limit_point,  ///< the branch turns back in s, a minimum meets a saddle
  bifurcation,  ///< H loses definiteness while s goes on: the branch goes on unstable
  regular,      ///< no end: the branch goes on as minima, only strongly curved
  unresolved,   ///< the curve could not be followed
};
std::string_view name(BranchEnd end);

/// Where a branch of minima ends.
struct Fold {
  BranchEnd end = BranchEnd::unresolved;
  double s = 0;                  ///< of the last point, at a limit point that of the fold
  VecX x;                        ///< 3n [m]
  VecX onward;                   ///< direction of the curve there (3n), largest vertex move 1 m
  int negative_eigenvalues = 0;  ///< of H just beyond
};

/// Follows the curve from a minimum that natural steps in the given direction of s (+1, -1) could
/// not leave, until the kind of its end is known or it has gone on as minima for 8 smallest steps.
Fold trace_fold(Potential& potential, const FabricPath& path, const BranchState& last,
                double direction, const BranchOptions& options, ContinuationCost& cost);

struct Snap {
  Fold fold;
  double s = 0;            ///< where the state after the snap was found
  VecX x;                  ///< that state (3n) [m]
  double vertex_jump = 0;  ///< largest way of a vertex, from the end of the branch [m]
  double energy_drop = 0;  ///< at s, from the end of the branch to the state after it [J]
};

/// What a sweep reports; both may be empty. `point` may stop the sweep by returning false.
struct SweepVisitor {
  std::function<bool(const BranchState&)> point;
  std::function<void(const Snap&)> snap;
};

/// Goes from `state` to s1 along branches of minima. Where one ends the state snaps: it is
/// minimised a little further on, and the sweep goes on along the branch it falls to. `state`
/// becomes the last minimum. Returns whether s1 was reached; false when `point` stopped it or no
/// minimum was found.
bool sweep(Potential& potential, const FabricPath& path, double s1, const BranchOptions& options,
           BranchState& state, ContinuationCost& cost, const SweepVisitor& visitor = {});

}  // namespace drape
