// The outline of a drape's shadow: what a camera above the instrument sees.
//
// Shadow = union of the triangles projected along z and the support disc. Its outline is the outer
// boundary of that union, a simple polygon whose corners are projected mesh vertices, crossings of
// two projected edges, or fixed points on the support disc (only where the cloth does not hide it).
// The outline is a piecewise smooth function of the state: its derivative is exact as long as the
// list of edges that form it does not change. Holes inside the outer boundary count as shadow.
#pragma once

#include <array>
#include <vector>

#include "core/mesh.h"
#include "core/scene.h"
#include "core/types.h"

namespace drape {

/// Where a corner of the outline comes from.
struct OutlineCorner {
  enum class Kind { vertex, crossing, support };
  Kind kind;
  /// vertex: [0] is the mesh vertex. crossing: projected edges ([0],[1]) and ([2],[3]) intersect,
  /// where an edge of the support disc has both indices -1. support: unused.
  std::array<int, 4> vertices{-1, -1, -1, -1};
  /// crossing with an edge of the support disc: that edge's end points [m].
  std::array<Vec2, 2> support_edge{Vec2::Zero(), Vec2::Zero()};
};

/// Counter-clockwise simple polygon.
struct Outline {
  Points2 points;                      ///< corners [m]
  std::vector<OutlineCorner> corners;  ///< as many as points
  int size() const { return static_cast<int>(points.rows()); }
};

/// Outline of the shadow of state x (3n) [m]. Throws std::runtime_error if the boundary cannot be
/// traced (a state with non-finite coordinates, for example).
Outline trace_outline(const Mesh& mesh, const Scene& scene, const VecX& x);

/// dL/dx (3n) from dL/dpoints (one row a corner): the transpose of the outline's Jacobian.
VecX pull_back(const Outline& outline, const VecX& x, const Points2& dL_dpoints);

/// Velocity of the corners (one row a corner) when the state moves with velocity dx (3n).
Points2 push_forward(const Outline& outline, const VecX& x, const VecX& dx);

/// Enclosed area [m^2] and its derivative with respect to the corners.
double area(const Points2& polygon);
Points2 area_gradient(const Points2& polygon);

/// Area centroid [m].
Vec2 centroid(const Points2& polygon);

/// DC = (A - pi r_s^2) / (pi R^2 - pi r_s^2), as a fraction (Cusick).
double drape_coefficient(const Scene& scene, double shadow_area);

}  // namespace drape
