// Signed distances of fixed points from an outline, positive outside of it.
//
// With P the nearest point of the polygon and n the unit vector that points from it to the outside,
// d = n . (Q - P) and dd = -n . dP: where P slides along the outline, it slides across n. Exact
// wherever the nearest point is unique; d itself is continuous everywhere. Unlike a radius, it
// needs no star-shaped outline.
#pragma once

#include <vector>

#include "core/types.h"

namespace drape {

/// One entry a point. Its nearest point lies on the edge from corner `edge` to the next one, at
/// the fraction `fraction` of that edge.
struct SignedDistances {
  VecX distance;  ///< [m]
  std::vector<int> edge;
  std::vector<double> fraction;  ///< in [0, 1]
  Points2 outward;               ///< n
};

/// `polygon`: simple, counter-clockwise, at least three corners, else std::invalid_argument.
SignedDistances signed_distances(const Points2& polygon, const Points2& at);

/// dL/dpolygon (one row a corner) from dL/ddistance.
Points2 pull_back(const SignedDistances& distances, const Points2& polygon,
                  const VecX& dL_ddistance);

/// Rate of the distances when the corners move with velocity dpolygon.
VecX push_forward(const SignedDistances& distances, const Points2& dpolygon);

/// `count` points of a closed polygon at equal steps of its length, from its first corner on.
Points2 equally_spaced(const Points2& polygon, int count);

}  // namespace drape
