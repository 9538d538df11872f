// Small meshes, fabrics and states for the tests of the cloth model and the benchmarks.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/disc_mesh.h"
#include "core/mesh.h"
#include "core/potential.h"
#include "core/random.h"
#include "core/scene.h"

namespace drape::test {

/// One triangle of no particular shape, 10 mm large.
inline Mesh one_triangle() {
  Points2 uv(3, 2);
  uv << 0, 0, 0.011, 0.002, 0.003, 0.009;
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  return make_mesh(uv, triangles, {0, 0, 0});
}

/// One wing: edge 0 -> 1 of length `edge` at the angle `direction` from u, apexes at the heights
/// given to its left (vertex 2) and right (vertex 3). Fixed: the left triangle if `clamped`.
inline Mesh one_wing(double edge, double left, double right, double direction, bool clamped = false,
                     double clamp_wing_factor = 2) {
  Points2 uv(4, 2);
  uv << 0, 0, edge, 0, 0.4 * edge, left, 0.7 * edge, -right;
  const Eigen::Rotation2Dd turn(direction);
  for (int i = 0; i < 4; ++i) uv.row(i) = (turn * Vec2(uv.row(i))).transpose();
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 1, 0, 3;
  const std::uint8_t fixed = clamped;
  return make_mesh(uv, triangles, {fixed, fixed, fixed, 0}, clamp_wing_factor);
}

/// A strip of equilateral triangles along u, from u = 0 to about `length`, `cells` edges wide with
/// straight sides v = 0 and v = width. One column of triangles at u < 0 is fixed, as is u = 0.
inline Mesh strip(double length, double width, int cells) {
  const double h = width / cells, column_width = std::sqrt(0.75) * h;
  const int columns = static_cast<int>(std::lround(length / column_width));
  std::vector<Vec2> points;
  std::vector<std::vector<int>> column_vertices;
  for (int i = -1; i <= columns; ++i) {
    std::vector<int>& column = column_vertices.emplace_back();
    const auto add = [&](double v) {
      column.push_back(static_cast<int>(points.size()));
      points.emplace_back(i * column_width, v);
    };
    if (i % 2 == 0) {
      for (int j = 0; j <= cells; ++j) add(j * h);
    } else {
      add(0);
      for (int j = 0; j < cells; ++j) add((j + 0.5) * h);
      add(width);
    }
  }
  std::vector<Eigen::RowVector3i> triangles;
  for (size_t i = 0; i + 1 < column_vertices.size(); ++i) {
    const std::vector<int>&a = column_vertices[i], &b = column_vertices[i + 1];
    const auto v = [&](int vertex) { return points[static_cast<size_t>(vertex)].y(); };
    for (size_t p = 0, q = 0; p + 1 < a.size() || q + 1 < b.size();) {
      // the lower of the next two vertices; at the straight side, that of the shorter column
      const double handicap = b.size() > a.size() ? 0.1 * h : -0.1 * h;
      const bool next_on_b =
          p + 1 == a.size() || (q + 1 < b.size() && v(b[q + 1]) + handicap < v(a[p + 1]));
      if (next_on_b) {
        triangles.emplace_back(a[p], b[q], b[q + 1]);
        ++q;
      } else {
        triangles.emplace_back(a[p], b[q], a[p + 1]);
        ++p;
      }
    }
  }
  Points2 uv(static_cast<Eigen::Index>(points.size()), 2);
  std::vector<std::uint8_t> fixed(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    uv.row(static_cast<Eigen::Index>(i)) = points[i];
    fixed[i] = points[i].x() < 1e-9;
  }
  Triangles list(static_cast<Eigen::Index>(triangles.size()), 3);
  for (size_t t = 0; t < triangles.size(); ++t)
    list.row(static_cast<Eigen::Index>(t)) = triangles[t];
  return make_mesh(std::move(uv), std::move(list), std::move(fixed));
}

inline const Scene kCusick;  // the standard instrument

inline std::shared_ptr<const Discretization> disc(int vertices,
                                                  FactorBackend backend = default_factor_backend(),
                                                  std::uint64_t seed = 1) {
  return std::make_shared<const Discretization>(
      make_disc_mesh(kCusick, {.vertices = vertices, .seed = seed, .clamp_refinement = 1}),
      backend);
}

/// A fabric whose drape has few folds.
inline Fabric stiff_fabric() {
  Fabric fabric;
  fabric.areal_density = 0.25;
  fabric.k_u = 3000;
  fabric.k_v = 2000;
  fabric.k_h = 70;
  fabric.k_bu = 2e-5;
  fabric.k_bv = 1.2e-5;
  fabric.k_bh = 1.5e-5;
  return fabric;
}

/// A fabric with all parameters different, that softens where it is bent.
inline Fabric medium_fabric() {
  Fabric fabric;
  fabric.areal_density = 0.2;
  fabric.k_u = 1500;
  fabric.k_v = 900;
  fabric.k_h = 50;
  fabric.k_bu = 5e-6;
  fabric.k_bv = 3e-6;
  fabric.k_bh = 4e-6;
  fabric.s_bu = 0.6;
  fabric.s_bv = 0.7;
  fabric.s_bh = 0.5;
  fabric.t_bu = 0.35;
  fabric.t_bv = 0.3;
  fabric.t_bh = 0.4;
  return fabric;
}

/// The state with every free vertex moved at random by up to `amount` [m].
inline VecX shaken(const Mesh& mesh, VecX x, double amount, std::uint64_t seed = 1) {
  Random random(seed);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (!mesh.fixed[static_cast<size_t>(v)])
      for (int k = 0; k < 3; ++k) x[3 * v + k] += amount * random.uniform(-1, 1);
  return x;
}

/// The rest state rolled on a cylinder of curvature kappa [1/m] whose axis is perpendicular to the
/// direction at `angle` from u; flat on the other side of the line through the origin if
/// `one_sided`.
inline VecX cylinder(const Mesh& mesh, double kappa, double angle, bool one_sided = false) {
  const Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  VecX x = flat_state(mesh);
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    const Vec2 uv = mesh.rest_uv.row(i);
    const double s = uv.dot(along);
    if (one_sided && s <= 0) continue;
    const Vec2 plane = std::sin(kappa * s) / kappa * along + uv.dot(across) * across;
    x.segment<3>(3 * i) << plane, -(1 - std::cos(kappa * s)) / kappa;
  }
  return x;
}

/// Bending energy alone [J]: the sum over the wings.
inline double bending_energy(const Mesh& mesh, const Fabric& fabric, const VecX& x,
                             BendingReading reading = {}) {
  double sum = 0;
  for (const Wing& wing : mesh.wings) {
    Corners4<double> corners;
    for (size_t k = 0; k < 4; ++k)
      corners.col(static_cast<Eigen::Index>(k)) = position(x, wing.vertices[k]);
    sum += wing_energy(wing_law(wing, fabric, reading), fold_angle(corners));
  }
  return sum;
}

}  // namespace drape::test
