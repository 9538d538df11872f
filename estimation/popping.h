// Popping single vertices of a drape through, to reach the branch that an outline shows.
//
// Near the feet of folds a stiff membrane holds single vertices of a mesh popped to one side or the
// other (core/settled.h), and drapes that differ by some of them are neighbours with nearly the
// same outline. A vertex mirrored in the plane of its neighbours, from where the drape is minimised
// again, leads to such a neighbour. Whether that one is nearer to the observed outline is seen
// without a fit: from what of the miss no change of the unknowns takes away, to first order.
#pragma once

#include <vector>

#include "core/mesh.h"
#include "estimation/estimate.h"

namespace drape {

class StagedFit;

/// A vertex off the plane of its neighbours, and where that plane mirrors it to.
struct Pop {
  int vertex;
  Vec3 to;  ///< [m]
};

/// Those of the free inner vertices of state x (3n) that lie further from the plane of their
/// neighbours than `least_height` times the mean distance from them.
std::vector<Pop> poppable(const Mesh& mesh, const VecX& x, double least_height);

/// What is left of residuals when the unknowns may change: the linear step that does best, the
/// standard deviation of each unknown's change being `reach` for residuals of size `scale`.
class ReachableResidual {
 public:
  ReachableResidual(const MatX& jacobian, double scale, double reach);
  double norm(const VecX& residuals) const;

 private:
  MatX range_;  // orthonormal, of the jacobian over the step's weight
  double scale_;
};

/// From a free fit at hand to better ones: the vertices near what is missed are popped one by one;
/// where a fit from there explains the outlines better, the search goes on from it. Ends where no
/// vertex helps, the outlines are explained well, or after `max_pops`; then the best state is at
/// hand. True if it is better than the first.
bool pop_through(StagedFit& fit, int max_pops);

}  // namespace drape
