#include "core/lloyd.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/delaunay.h"

namespace drape {
namespace {

constexpr int kLloydIterations = 40;
constexpr double kOverRelaxation = 1.7;  // twice as fast as plain steps, and still stable

Vec2 circumcentre(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 p = b - a, q = c - a;
  const double d = 2 * (p.x() * q.y() - p.y() * q.x());
  return a + Vec2(q.y() * p.squaredNorm() - p.y() * q.squaredNorm(),
                  p.x() * q.squaredNorm() - q.x() * p.squaredNorm()) /
                 d;
}

/// Every inside point moves past the centroid of its Voronoi cell, summed over signed triangles
/// (point, circumcentre, midpoint of an edge) with the density in their middle.
void relax_once(Points2& points, const MeshRegion& region) {
  const Triangles triangles = region_triangles(points, region);
  VecX mass = VecX::Zero(points.rows());
  Points2 moment = Points2::Zero(points.rows(), 2);
  for (int t = 0; t < triangles.rows(); ++t) {
    Vec2 corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = points.row(triangles(t, k));
    const Vec2 centre = circumcentre(corner[0], corner[1], corner[2]);
    for (int k = 0; k < 3; ++k) {
      const Vec2& p = corner[k];
      const auto add = [&](const Vec2& a, const Vec2& b) {
        const double signed_area = ((a - p).x() * (b - p).y() - (a - p).y() * (b - p).x()) / 2;
        const double share = signed_area * region.density((p + a + b) / 3);
        mass[triangles(t, k)] += share;
        moment.row(triangles(t, k)) += share * (p + a + b).transpose() / 3;
      };
      add((p + corner[(k + 1) % 3]) / 2, centre);
      add(centre, (p + corner[(k + 2) % 3]) / 2);
    }
  }
  for (Eigen::Index i = region.boundary_points; i < points.rows(); ++i) {
    if (!(mass[i] > 0)) continue;
    const Vec2 centroid = moment.row(i).transpose() / mass[i], here = points.row(i);
    points.row(i) = region.restrain(here + kOverRelaxation * (centroid - here));
  }
}

}  // namespace

double inside_count(double area, double h, double boundary) {
  return area / (std::sqrt(3.0) / 2 * h * h) - boundary / 2;
}

Vec2 uniform_point(Random& random) {
  const double a = random.uniform();
  return {a, random.uniform()};
}

Triangles region_triangles(const Points2& points, const MeshRegion& region) {
  const Triangles all = delaunay(points);
  Triangles kept(all.rows(), 3);
  int count = 0;
  for (int t = 0; t < all.rows(); ++t)
    if (region.contains(all.row(t))) kept.row(count++) = all.row(t);
  return kept.topRows(count);
}

void relax(Points2& points, const MeshRegion& region) {
  for (int i = 0; i < kLloydIterations; ++i) relax_once(points, region);
}

void add_fixed_row(Points2& points, Triangles& triangles, int first_clamp, int clamp_count,
                   bool closed) {
  const int edges = closed ? clamp_count : clamp_count - 1;
  std::vector<int> apex(static_cast<size_t>(edges), -1);
  for (int t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      // in front of the line, its edges run backwards around a counter-clockwise triangle
      const int to = triangles(t, (k + 1) % 3) - first_clamp;
      const int from = triangles(t, k) - first_clamp;
      if (to >= 0 && to < edges && from == (to + 1) % clamp_count)
        apex[static_cast<size_t>(to)] = triangles(t, (k + 2) % 3);
    }
  const int first_back = static_cast<int>(points.rows());
  const int gaps = closed ? edges : edges - 1;
  Eigen::Index next_triangle = triangles.rows();
  points.conservativeResize(first_back + edges, 2);
  triangles.conservativeResize(next_triangle + edges + gaps, 3);
  for (int i = 0; i < edges; ++i) {
    const int a = first_clamp + i, b = first_clamp + (i + 1) % clamp_count;
    const int front = apex[static_cast<size_t>(i)];
    if (front < 0) throw std::runtime_error("mesh: the clamp line is not made of edges");
    const Vec2 p = points.row(a), q = points.row(b), r = points.row(front);
    const Vec2 along = (q - p).normalized(), forward(along.y(), -along.x());
    points.row(first_back + i) = (p + q) / 2 - forward * (r - p).dot(forward);
    triangles.row(next_triangle++) << a, b, first_back + i;
    if (i < gaps) triangles.row(next_triangle++) << b, first_back + (i + 1) % edges, first_back + i;
  }
}

}  // namespace drape
