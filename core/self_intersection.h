// Self-intersections of a cloth: pairs of triangles that cross each other.
//
// Broad phase: sort-and-sweep of the bounding boxes along x; all in all 2 ms at 2k vertices and
// 65 ms at 30k, little beside a drape: a grid or a tree would save nothing that counts. Narrow
// phase: two triangles cross if and only if an edge of one passes through the other, decided by the
// signs of volumes of tetrahedra with the error bound of Shewchuk (1997, orient3d, stage A). An
// edge counts whose ends lie on both sides of the other's plane, each by more than rounding (about
// 1e-16 m in a cloth of this size). So no pair is reported whose triangles lie further apart than
// rounding, and every pair is found of which an edge passes through the other so clearly. Triangles
// that only touch, or overlap within one plane, are not reported.
//
// Triangles that share one vertex meet there by right; they cross if the edge of one opposite to
// that vertex passes through the other. Triangles that share an edge can only overlap when folded
// flat upon each other: they are not tested.
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
