// Flexural rigidity of a cloth and the bending stiffness of the wings of its mesh.
//
// A wing of any direction takes part in every bend, so B (what a bending test measures, moment a
// width over curvature) and k_b (Eq. 3-5 of Ju et al. 2024, supplement) are related by
//   (B_u, B_v, B_45) / 4 = M (k_bu, k_bv, k_bh)
// with M averaged over the wings of an isotropic unstructured mesh; with equal k_b, B = 4 k_b.
#pragma once

#include "core/fabric.h"
#include "core/types.h"

namespace drape {

/// (B_u, B_v, B_45) of a fabric below its bending threshold: weft, warp, bias [N m].
Vec3 effective_rigidity(const Fabric& fabric);

/// Wing stiffnesses that come closest to a measured rigidity.
struct HingeStiffness {
  Vec3 k_b;       ///< (k_bu, k_bv, k_bh), not negative; may be zero, which no Fabric allows [N m]
  double misfit;  ///< |4 M k_b - B| / |B|; zero where B can be reached [1]
};

/// Non-negative least squares for B = (B_u, B_v, B_45) [N m]. A strong anisotropy cannot be
/// reached: the misfit says by how much. Throws std::invalid_argument unless all of B is positive
/// and finite.
HingeStiffness hinge_stiffness(const Vec3& rigidity);

}  // namespace drape
