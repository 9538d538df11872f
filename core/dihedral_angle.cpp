#include "core/dihedral_angle.h"

namespace drape {
namespace {

/// One triangle of the wing with its apex c; `turn` is +1 left of the edge and -1 right of it.
struct Side {
  Vec3 n, m;      // unit normal; in-plane unit normal of the edge, towards c
  double N;       // twice the area
  double s0, s1;  // the gradient of delta is n s0/N, n s1/N, n l/N at x0, x1, c
};

Side make_side(const Corners4<double>& x, int apex, double turn, const Vec3& e, double l) {
  Side side;
  const Vec3 to_apex = x.col(apex) - x.col(0);
  const Vec3 normal = turn * e.cross(to_apex) * l;
  side.N = normal.norm();
  side.n = normal / side.N;
  side.m = turn * side.n.cross(e);
  side.s1 = -to_apex.dot(e);
  side.s0 = (x.col(apex) - x.col(1)).dot(e);
  return side;
}

void add_gradient(const Side& side, int apex, double l, Vec12& g) {
  g.segment<3>(0) += side.n * (side.s0 / side.N);
  g.segment<3>(3) += side.n * (side.s1 / side.N);
  g.segment<3>(3 * apex) += side.n * (l / side.N);
}

void add_hessian(const Side& side, int apex, const Vec3& e, double l, Mat12& H) {
  const double N2 = side.N * side.N, lN = l * side.N, half = 1 / (2 * l * l);
  const double s0 = side.s0, s1 = side.s1;
  Mat3 M, Q;                                                      // rows and columns: x0, x1, c
  M << -s0 * s0 / N2 - half, -s0 * s1 / N2 + half, -s0 * l / N2,  //
      -s0 * s1 / N2 + half, -s1 * s1 / N2 - half, -s1 * l / N2,   //
      -s0 * l / N2, -s1 * l / N2, -l * l / N2;
  Q << s0 / lN, s1 / lN, 1 / side.N,    //
      -s0 / lN, -s1 / lN, -1 / side.N,  //
      0, 0, 0;
  const int corner[3] = {0, 1, apex};
  // the outer products n m^T and n e^T carry all directions; the coefficients vary with (i, j)
  const Mat3 nm = side.n * side.m.transpose(), ne = side.n * e.transpose();
  const Mat3 nm_symmetric = nm + nm.transpose();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      H.block<3, 3>(3 * corner[i], 3 * corner[j]) +=
          M(i, j) * nm_symmetric + Q(i, j) * ne + Q(j, i) * ne.transpose();
}

}  // namespace

Vec12 fold_angle_gradient(const Corners4<double>& x) {
  const Vec3 edge = x.col(1) - x.col(0);
  const double l = edge.norm();
  Vec12 g = Vec12::Zero();
  add_gradient(make_side(x, 2, 1, edge / l, l), 2, l, g);
  add_gradient(make_side(x, 3, -1, edge / l, l), 3, l, g);
  return g;
}

void fold_angle_derivatives(const Corners4<double>& x, Vec12& gradient, Mat12& hessian) {
  const Vec3 edge = x.col(1) - x.col(0);
  const double l = edge.norm();
  const Vec3 e = edge / l;
  gradient.setZero();
  hessian.setZero();
  const Side left = make_side(x, 2, 1, e, l), right = make_side(x, 3, -1, e, l);
  add_gradient(left, 2, l, gradient);
  add_gradient(right, 3, l, gradient);
  add_hessian(left, 2, e, l, hessian);
  add_hessian(right, 3, e, l, hessian);
}

}  // namespace drape
