// Isotropic unstructured meshes: Lloyd's relaxation (1982) of points in a plane region towards a
// centroidal Voronoi tessellation, and the fixed row of triangles behind a clamp line.
//
// The hinge energy depends on the directions of a mesh's edges; after Lloyd's iterations from
// random points no direction is preferred (lattices and concentric rings are up to 3 times stiffer
// in some, and the lattice of a low-discrepancy start survives by 10 %).
#pragma once

#include <functional>

#include "core/random.h"
#include "core/types.h"

namespace drape {

/// A region to be meshed: its boundary is made of the first points, which stay where they are.
struct MeshRegion {
  int boundary_points;
  /// Whether a Delaunay triangle (its vertex indices) belongs to the region.
  std::function<bool(const Eigen::RowVector3i&)> contains;
  /// The allowed place nearest to a point on its way [m].
  std::function<Vec2(const Vec2&)> restrain;
  /// Where edges of length h are wanted: proportional to h^-4 (Du, Faber and Gunzburger 1999).
  std::function<double(const Vec2&)> density = [](const Vec2&) { return 1.0; };
};

/// Vertices inside of a region of the given area for equilateral triangles of edge h: by Euler,
/// area / (sqrt(3)/4 h^2) = 2 inside + boundary triangles, less 2 for a region without a hole.
double inside_count(double area, double h, double boundary);

/// A point of the unit square.
Vec2 uniform_point(Random& random);

/// Delaunay triangles of the points that belong to the region.
Triangles region_triangles(const Points2& points, const MeshRegion& region);

/// Moves the points inside towards the centroids of their Voronoi cells, weighted by the density,
/// and beyond (over-relaxed), 40 times.
void relax(Points2& points, const MeshRegion& region);

/// The fixed row behind a clamp line: one triangle behind every edge, as high as the one in front,
/// and the triangles that fill the gaps between them. The line's vertices follow each other from
/// `first_clamp`, with the region to their right; `closed` if the last is followed by the first.
/// Appends the row's back vertices. Throws std::runtime_error where the line is not made of edges.
void add_fixed_row(Points2& points, Triangles& triangles, int first_clamp, int clamp_count,
                   bool closed);

}  // namespace drape
