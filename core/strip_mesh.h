// The mesh of a strip of cloth clamped at one end, as in cantilever and tensile tests: isotropic
// and unstructured like the disc's (lloyd.h).
//
// The strip is cut at an angle from the weft. Its rest state starts at the clamp line through the
// origin and extends to +u, turned by that angle; one fixed row of triangles lies behind the clamp
// line.
#pragma once

#include <cstdint>

#include "core/mesh.h"

namespace drape {

struct StripMeshOptions {
  double length = 0.2;         ///< free length [m]
  double width = 0.025;        ///< [m]
  double edge_length = 0.004;  ///< of the triangles, about; at most a third of length and width [m]
  double angle = 0;            ///< of the length from the weft u [rad]
  std::uint64_t seed = 1;      ///< another seed, another mesh of the same kind
  double clamp_wing_factor = 2;  ///< weight of the wings on the clamp line
};

/// Deterministic for given options. Throws std::invalid_argument on sizes that are not positive or
/// edges that are too long.
Mesh make_strip_mesh(const StripMeshOptions& options);

/// Place of a vertex in the strip: distance from the clamp line (negative behind it) and from the
/// middle line [m].
Vec2 place_in_strip(const StripMeshOptions& options, const Vec2& rest_uv);

}  // namespace drape
