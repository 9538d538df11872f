// Bending energy of one wing (Eqs. 3 to 11 of Ju et al. 2024) as a function of its fold angle
// delta.
//
//   E = k_b(phi) w f(|delta|; s_b(phi), delta*),   w = e/L_a + e/L_b   (no factor 1/2, Eq. 3)
//
// k_b, s_b and t_b are interpolated in the bending direction phi (Eqs. 4, 5, 10, 11); the threshold
// delta* follows from t_b (Eqs. 6 to 9). Below it f = delta^2; past it, with d = |delta|,
//   tangent: f = delta*^2 + 2 delta* (d - delta*) + s_b (d - delta*)^2   (C1)
//   secant:  f = s_b d^2                                                 (to the letter; it jumps)
//
// Moments and tangents, which the solver needs, are in batched_bending.h.
//
// A mesh of equilateral triangles with k_bu = k_bv = k_bh bends like a plate of rigidity B = 4 k_b.
#pragma once

#include "core/dihedral_angle.h"
#include "core/fabric.h"
#include "core/mesh.h"

namespace drape {

/// Weights of the u, v and h values at the bending direction phi in [0, pi/2] (Eq. 4).
Vec3 interpolation_weights(double phi);

/// R_b(t_b) in millimetres (Eq. 9) and its derivative.
double threshold_radius_mm(double t_b);
double threshold_radius_mm_derivative(double t_b);

/// Everything of a wing's energy but its fold angle.
struct WingLaw {
  BendingLaw law;
  Vec3 weights;                 ///< of u, v, h (Eq. 4)
  double stiffness;             ///< k_b(phi) w [J]
  double weight;                ///< w [1]
  double scale;                 ///< s_b(phi)
  double threshold;             ///< delta* in [0, pi] [rad]
  double threshold_derivative;  ///< d(delta*)/d(t_b)
};

WingLaw wing_law(const Wing& wing, const Fabric& fabric, BendingReading reading);

/// Whether a fold angle lies past the threshold.
inline bool past_threshold(const WingLaw& law, double delta) {
  return std::abs(delta) >= law.threshold;
}

/// E(delta) [J]; Scalar is a double or an automatic-differentiation type.
template <typename Scalar>
Scalar wing_energy(const WingLaw& law, const Scalar& delta) {
  using std::abs;
  const Scalar d = abs(delta);
  if (d < Scalar(law.threshold)) return Scalar(law.stiffness) * d * d;
  if (law.law == BendingLaw::secant) return Scalar(law.stiffness * law.scale) * d * d;
  const Scalar beyond = d - Scalar(law.threshold);
  return Scalar(law.stiffness) *
         (Scalar(law.threshold * law.threshold) + Scalar(2 * law.threshold) * beyond +
          Scalar(law.scale) * beyond * beyond);
}

/// d(dE/d delta)/d(k_bu, k_bv, k_bh, s_bu, s_bv, s_bh, t_bu, t_bv, t_bh).
Eigen::Matrix<double, 9, 1> wing_moment_dfabric(const WingLaw& law, double delta);

}  // namespace drape
