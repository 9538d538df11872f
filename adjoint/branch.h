// Following a branch of minima along a path of fabrics p(s): natural continuation.
//
// Where H = d2E/dx2 is regular the equilibria form a smooth branch x(s), dx/ds = -H^-1 dg/dp dp/ds.
// A step predicts x + (dx/ds) ds and minimises from there; it counts only when the minimum lies
// close to the prediction, relative to the predicted movement, which a snap to another branch does
// not. (The smallest eigenvalue is no such sign: it is small everywhere.) Otherwise the step is
// halved. What a branch does where no step is small enough: fold.h.
#pragma once

#include <functional>
#include <vector>

#include "core/equilibrium.h"
#include "core/fabric.h"
#include "core/potential.h"

namespace drape {

/// A curve in the space of parameters.
struct FabricPath {
  std::function<Fabric(double s)> fabric;
  std::function<ParameterVector(double s)> dp_ds;  ///< natural units over unit s
};

/// Some parameters multiplied by e^s, the others held.
FabricPath scaled_path(const Fabric& fabric, const std::vector<Parameter>& parameters);

/// A converged equilibrium on a path, with its tangent.
struct BranchState {
  double s = 0;
  Equilibrium equilibrium;
  VecX dx_ds;  ///< 3n [m]
};

struct BranchOptions {
  double largest_step = 0.05;       ///< of s
  double smallest_step = 2e-3;      ///< of s: no step that counts below it means the branch is lost
  double largest_deviation = 0.35;  ///< of the minimum from the prediction, over predicted movement
  double noise = 2e-5;              ///< deviations below this are never a snap [m]
  EquilibriumOptions equilibrium;
};

/// How far [m] a minimum may lie from the state predicted from `from` and still be on its branch.
double allowed_deviation(const BranchOptions& options, const VecX& predicted, const VecX& from);

/// Work done, summed over calls.
struct ContinuationCost {
  int solves = 0;
  int newton_iterations = 0;
  int factorizations = 0;
};

/// dg/ds (3n) [N] at constant x; the potential has the fabric of s.
VecX gradient_ds(const Potential& potential, const FabricPath& path, double s, const VecX& x);

/// Throws std::invalid_argument unless the equilibrium is a certified minimum of the potential,
/// which has the fabric of s.
BranchState make_branch_state(const Potential& potential, const FabricPath& path, double s,
                              Equilibrium equilibrium);

/// Follows the branch of minima from `state` towards s1; `state` becomes the last one that counts,
/// and `visit`, if given, sees each and stops by false. Returns whether s1 was reached. `potential`
/// (guide and gravity as set) ends with the fabric of the last state tried.
bool follow_minima(Potential& potential, const FabricPath& path, double s1,
                   const BranchOptions& options, BranchState& state, ContinuationCost& cost,
                   const std::function<bool(const BranchState&)>& visit = {});

}  // namespace drape
