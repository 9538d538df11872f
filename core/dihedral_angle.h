// The fold angle of a wing: delta = pi - theta, where theta is the angle between its two triangles.
//
// delta is 0 when the wing is flat and positive for a valley seen from the side of the normals.
// Corners are the columns of a 3x4 matrix in the order of Wing::vertices: the shared edge x0 -> x1,
// the apex to its left x2, the apex to its right x3.
#pragma once

#include <cmath>

#include "core/types.h"

namespace drape {

template <typename Scalar>
using Corners4 = Eigen::Matrix<Scalar, 3, 4>;
using Vec12 = Eigen::Matrix<double, 12, 1>;

/// delta in (-pi, pi] [rad]; templated so that tests can differentiate it automatically.
template <typename Scalar>
Scalar fold_angle(const Corners4<Scalar>& x) {
  using std::atan2;
  using std::sqrt;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  const Vector edge = x.col(1) - x.col(0);
  const Vector left = edge.cross(x.col(2) - x.col(0));
  const Vector right = (x.col(3) - x.col(0)).cross(edge);
  return atan2(right.cross(left).dot(edge) / sqrt(edge.squaredNorm()), left.dot(right));
}

/// d(delta)/dx [1/m], corners in order.
Vec12 fold_angle_gradient(const Corners4<double>& x);

}  // namespace drape
