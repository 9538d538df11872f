// The constant part of a drape: rest shape, triangles, wings, clamp.
//
// A wing is the pair of triangles beside an inner edge (Fig. 1 of Ju et al. 2024). Vertices that
// belong to the clamp are fixed at their rest position, at z = 0.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types.h"

namespace drape {

/// Two triangles that share the edge (vertices[0], vertices[1]); vertices[2] completes the triangle
/// to the left of that edge, vertices[3] the one to its right (seen from +z in the rest state).
struct Wing {
  std::array<int, 4> vertices;
  double weight;       ///< e/L_a + e/L_b of Eq. 3, times the clamp factor on the clamp line [1]
  double mean_height;  ///< L_avg of Eq. 8 [m]
  double phi;          ///< angle of the bending direction from u, folded into [0, pi/2] (Eq. 4)
  bool on_clamp_line;  ///< the shared edge is fixed and one side is free
};

/// Linear triangle: w_u = sum_i du[i] x_i, w_v = sum_i dv[i] x_i (i over its three vertices).
struct RestTriangle {
  double area;  ///< [m^2]
  Vec3 du, dv;  ///< derivatives of the three shape functions [1/m]
};

struct Mesh {
  Points2 rest_uv;                  ///< rest positions (u, v), one row a vertex [m]
  Triangles triangles;              ///< counter-clockwise; includes the fixed ring
  std::vector<std::uint8_t> fixed;  ///< 1 for clamped vertices
  double clamp_wing_factor = 2;     ///< factor on the weight of wings on the clamp line
  std::vector<RestTriangle> rest;   ///< one a triangle
  std::vector<Wing> wings;          ///< every inner edge with at least one free vertex in its wing
  std::vector<int> boundary;        ///< rim vertices in counter-clockwise order
  VecX nodal_area;                  ///< a third of the area of the adjacent triangles [m^2]

  int vertex_count() const { return static_cast<int>(rest_uv.rows()); }
  int triangle_count() const { return static_cast<int>(triangles.rows()); }
  bool triangle_is_fixed(int triangle) const {
    return fixed[static_cast<size_t>(triangles(triangle, 0))] &&
           fixed[static_cast<size_t>(triangles(triangle, 1))] &&
           fixed[static_cast<size_t>(triangles(triangle, 2))];
  }
};

/// Derives everything that follows from rest shape, triangles and clamp. `boundary` is the longest
/// closed loop of boundary edges (the rim; an inner hole is shorter).
/// Throws std::invalid_argument on a vertex index out of range, a degenerate or clockwise triangle,
/// an edge of more than two triangles, a non-finite coordinate or an unused vertex.
Mesh make_mesh(Points2 rest_uv, Triangles triangles, std::vector<std::uint8_t> fixed,
               double clamp_wing_factor = 2);

/// The flat rest state, z = 0 (3n) [m].
VecX flat_state(const Mesh& mesh);

}  // namespace drape
