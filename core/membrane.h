// Stretch and shear energy of one triangle (Eqs. 1 and 2 of Ju et al. 2024; Baraff and Witkin 1998,
// Choi and Ko 2003), a sum over four directions c of the rest plane:
//
//   E = sum_c 1/2 k_c A (|w_c| - 1)^2,   w_u, w_v, w_RS = (w_u + w_v)/sqrt2, w_LS = (w_u -
//   w_v)/sqrt2
//
// with k_u, k_v, k_h, k_h. A stretch ratio below 1 is resisted like one above. Corner positions are
// the columns of a 3x3 matrix [m]; gradients order the corners vertex-major. The solver's kernels
// for whole meshes are in batched_membrane.h.
#pragma once

#include <cmath>

#include "core/fabric.h"
#include "core/mesh.h"
#include "core/types.h"

namespace drape {

/// The parameters of Eqs. 1 and 2 [N/m].
struct MembraneStiffness {
  double k_u, k_v, k_h;
};

template <typename Scalar>
using Corners3 = Eigen::Matrix<Scalar, 3, 3>;
using Vec9 = Eigen::Matrix<double, 9, 1>;

/// Coefficients over the three corners of the four directions u, v, RS, LS (columns) [1/m].
inline Eigen::Matrix<double, 3, 4> membrane_directions(const RestTriangle& rest) {
  Eigen::Matrix<double, 3, 4> c;
  c << rest.du, rest.dv, (rest.du + rest.dv) * M_SQRT1_2, (rest.du - rest.dv) * M_SQRT1_2;
  return c;
}

/// Energy [J]; templated so that tests can differentiate it automatically.
template <typename Scalar>
Scalar membrane_energy(const RestTriangle& rest, const MembraneStiffness& k,
                       const Corners3<Scalar>& x) {
  using std::sqrt;
  const Eigen::Matrix<double, 3, 4> c = membrane_directions(rest);
  const Eigen::Vector4d stiffness(k.k_u, k.k_v, k.k_h, k.k_h);
  const Eigen::Matrix<Scalar, 3, 1> e1 = x.col(1) - x.col(0), e2 = x.col(2) - x.col(0);
  Scalar energy(0);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Matrix<Scalar, 3, 1> w = e1 * Scalar(c(1, i)) + e2 * Scalar(c(2, i));
    const Scalar strain = sqrt(w.squaredNorm()) - Scalar(1);
    energy += Scalar(0.5 * stiffness[i] * rest.area) * strain * strain;
  }
  return energy;
}

/// dE/dx [N] of one triangle.
Vec9 membrane_gradient(const RestTriangle& rest, const MembraneStiffness& k,
                       const Corners3<double>& x);

/// d(dE/dx)/d(k_u, k_v, k_h) [m].
Eigen::Matrix<double, 9, 3> membrane_gradient_dstiffness(const RestTriangle& rest,
                                                         const Corners3<double>& x);

}  // namespace drape
