// One-sided contact of the cloth with the column below the clamping disc.
//
// The support is the solid cylinder r < a, z < 0 with a the column's radius. A free vertex inside
// of it, p = a - r and q = -z both positive, is at the distance min(p, q) from its surface. The
// penalty acts on a smooth lower bound of it,
//
//   d = p q / sqrt(p^2 + q^2)   (min(p, q) / sqrt(2) <= d <= min(p, q)),
//   E = sum_i w_i d_i^3 / (3 l^2),   w_i = areal_density g L sqrt(A_i),
//
// and is zero outside. d is homogeneous of degree one, so E is C2 everywhere off the axis, the rim
// r = a, z = 0 included. L is the overhang, sqrt(A_i) the width of a vertex: at the depth l a
// vertex is pushed with the weight of a strip of cloth of its width as long as the overhang.
// Scaling with the cloth's weight keeps what holds without contact: density and all stiffnesses
// times a number leave the shape as it was. A vertex outside feels nothing at all, however near it
// is.
//
// Only vertices are held. A facet's edge between two of them may cut the column by O(h^2 / a).
#pragma once

#include "core/mesh.h"
#include "core/scene.h"
#include "core/types.h"

namespace drape {

struct SupportContact {
  double column_radius;  ///< a [m]
  double overhang;       ///< L [m]
};
SupportContact support_contact(const Scene& scene);

/// Distance of a point inside the support from its surface, min(a - r, -z); 0 outside [m].
double support_penetration(const SupportContact& support, const Vec3& point);
/// Largest penetration of a free vertex in state x (3n) [m].
double support_penetration(const SupportContact& support, const Mesh& mesh, const VecX& x);

/// The smooth depth d and its derivatives; all 0 outside. Not finite on the axis.
struct SupportDepth {
  double value;
  Vec3 gradient;
  Mat3 hessian;  ///< negative semidefinite: d is concave
};
SupportDepth support_depth(const SupportContact& support, const Vec3& point);

/// Energy of one vertex [J], its gradient [N] and Hessian [N/m]; weight: w_i [N]. The negative part
/// of the Hessian, that of d'', is scaled by 1 - blend: 1 leaves a positive semidefinite block.
double support_energy(const SupportContact& support, double weight, const Vec3& point);
Vec3 support_gradient(const SupportContact& support, double weight, const Vec3& point);
Mat3 support_hessian(const SupportContact& support, double weight, const Vec3& point, double blend);

}  // namespace drape
