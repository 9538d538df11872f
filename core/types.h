// Scalar, vector and matrix types shared by all of Drape, and the layout of a state.
//
// A state x holds the positions of all n vertices, vertex-major: x = (x0 y0 z0 x1 y1 z1 ...), in
// metres, z up, the top of the support at z = 0. Signs: g = dE/dx, force = -g, adjoint H l =
// -dL/dx.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>

namespace drape {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using VecX = Eigen::VectorXd;
using MatX = Eigen::MatrixXd;

/// Points in the plane, one a row [m].
using Points2 = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
/// Triangles, one a row: three vertex indices, counter-clockwise in the (u, v) plane.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// Column-major sparse matrix; a symmetric one holds its lower triangle only.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// Position of one vertex in a state x (3n, vertex-major) [m].
inline Vec3 position(const VecX& x, int vertex) { return x.segment<3>(3 * vertex); }

/// Largest distance between corresponding vertices of two states (3n) [m].
inline double largest_distance(const VecX& a, const VecX& b) {
  return (a - b).reshaped(3, a.size() / 3).colwise().norm().maxCoeff();
}

}  // namespace drape
