// The mesh of Cusick's specimen: an isotropic unstructured annulus from the clamp to the rim.
//
// Vertices lie exactly on the rim and on the clamp circle; the inside is a centroidal Voronoi
// tessellation (Lloyd 1982, from random points), so no direction is preferred: with lattices or
// concentric rings the hinge energy is up to 3 times stiffer in some directions. Edges near the
// clamp may be shorter: there the sheet bends over the edge of the support within sqrt(B /
// tension), 5 to 10 mm. The part on the support is rigid and only one ring of its triangles is
// kept: each is as high over the clamp line as the triangle outside, as the weight of those wings
// assumes.
#pragma once

#include <cstdint>

#include "core/mesh.h"
#include "core/scene.h"

namespace drape {

struct DiscMeshOptions {
  int vertices = 2000;     ///< number of vertices, fixed ring included; at least 200
  std::uint64_t seed = 1;  ///< another seed, another mesh of the same kind
  double rotation = 0;     ///< of the mesh under the fabric [rad]
  double clamp_wing_factor =
      2;                        ///< weight of the wings on the clamp line; 1 makes the rim too soft
  double clamp_refinement = 2;  ///< edges at the rim over edges at the clamp; 1: all alike
};

/// Deterministic for given options. Throws std::invalid_argument on fewer than 200 vertices, a
/// refinement outside of 1 to 4 or an invalid scene.
Mesh make_disc_mesh(const Scene& scene, const DiscMeshOptions& options);

}  // namespace drape
