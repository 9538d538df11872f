// Self-intersections of a cloth: pairs of triangles that cross each other.
//
// Broad phase: sort-and-sweep of the bounding boxes along x. Narrow phase: two triangles cross if
// and only if an edge of one passes through the other, decided by the signs of volumes of
// tetrahedra with the error bound of Shewchuk (1997, orient3d, stage A). A sign that rounding could
// turn counts as zero, and zero is not a crossing: two triangles that touch, or lie in one plane
// within rounding, are not reported. So no pair is reported that does not meet, and every pair is
// found of which an edge passes through the other triangle's plane with both ends clear of it, by
// more than about 1e-16 m for a cloth of this size. Coplanar overlaps are not found.
//
// Triangles that share one vertex meet there by right; they cross if the edge of one opposite to
// that vertex passes through the other. Triangles that share an edge can only overlap when folded
// flat upon each other, which the bending energy forbids: they are not tested.
#pragma once

#include <array>
#include <vector>

#include "core/types.h"

namespace drape {

/// Pairs of triangle indices, each with the smaller first, in ascending order.
struct SelfIntersections {
  std::vector<std::array<int, 2>> disjoint;  ///< crossing pairs without a common vertex
  std::vector<std::array<int, 2>> adjacent;  ///< crossing pairs with one common vertex

  int count() const { return static_cast<int>(disjoint.size() + adjacent.size()); }
};

/// Of state x (3n), all coordinates finite. Throws std::invalid_argument if one is not.
SelfIntersections self_intersections(const Triangles& triangles, const VecX& x);

}  // namespace drape
