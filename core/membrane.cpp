#include "core/membrane.h"

namespace drape {
namespace {

/// w_c for the four directions, from edge vectors: positions cancel before they are scaled.
Eigen::Matrix<double, 3, 4> stretched_directions(const Eigen::Matrix<double, 3, 4>& c,
                                                 const Corners3<double>& x) {
  const Vec3 e1 = x.col(1) - x.col(0), e2 = x.col(2) - x.col(0);
  return e1 * c.row(1) + e2 * c.row(2);
}

}  // namespace

Vec9 membrane_gradient(const RestTriangle& rest, const MembraneStiffness& k,
                       const Corners3<double>& x) {
  const Eigen::Matrix<double, 3, 4> c = membrane_directions(rest);
  const Eigen::Matrix<double, 3, 4> w = stretched_directions(c, x);
  const double stiffness[4] = {k.k_u, k.k_v, k.k_h, k.k_h};
  Corners3<double> g = Corners3<double>::Zero();
  for (int i = 0; i < 4; ++i) {
    const double l = w.col(i).norm();
    g += (stiffness[i] * rest.area * (l - 1) / l) * w.col(i) * c.col(i).transpose();
  }
  return g.reshaped();
}

Eigen::Matrix<double, 9, 3> membrane_gradient_dstiffness(const RestTriangle& rest,
                                                         const Corners3<double>& x) {
  Eigen::Matrix<double, 9, 3> dg;
  dg.col(0) = membrane_gradient(rest, {1, 0, 0}, x);
  dg.col(1) = membrane_gradient(rest, {0, 1, 0}, x);
  dg.col(2) = membrane_gradient(rest, {0, 0, 1}, x);
  return dg;
}

}  // namespace drape
