#include "core/disc_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/delaunay.h"
#include "core/random.h"

namespace drape {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kLloydIterations = 40;
constexpr int kMinimumVertices = 200;

/// How many vertices go where for edges of length h.
struct Counts {
  int rim, clamp, inside;
};

/// An equilateral triangulation has area / (sqrt3/4 h^2) = 2 inside + boundary triangles (Euler).
/// The vertices of the fixed ring are as many as those on the clamp circle.
Counts counts_for(const Scene& scene, double h, int total) {
  const int rim = static_cast<int>(std::lround(2 * kPi * scene.specimen_radius / h));
  const int clamp = static_cast<int>(std::lround(2 * kPi * scene.support_radius / h));
  return {rim, clamp, total - rim - 2 * clamp};
}

double edge_length_for(const Scene& scene, int total) {
  const double annulus =
      kPi * (std::pow(scene.specimen_radius, 2) - std::pow(scene.support_radius, 2));
  double low = 1e-3 * scene.specimen_radius, high = scene.specimen_radius;
  for (int i = 0; i < 100; ++i) {
    const double h = (low + high) / 2;
    const double rim = 2 * kPi * scene.specimen_radius / h;
    const double clamp = 2 * kPi * scene.support_radius / h;
    const double inside = annulus / (std::sqrt(3.0) / 2 * h * h) - (rim + clamp) / 2;
    (inside + rim + 2 * clamp > total ? low : high) = h;
  }
  return low;
}

void set_circle(Points2& points, int first, int count, double radius, double phase) {
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * (i + phase) / count;
    points.row(first + i) = radius * Vec2(std::cos(angle), std::sin(angle));
  }
}

/// Uniform points in the open annulus: the R2 sequence (Roberts 2018), randomly shifted.
void set_inside(Points2& points, int first, const Scene& scene, double margin, Random& random) {
  constexpr double kPlastic = 1.32471795724474602596;
  const double shift_a = random.uniform(), shift_b = random.uniform();
  const double inner = std::pow(scene.support_radius + margin, 2);
  const double outer = std::pow(scene.specimen_radius - margin, 2);
  for (Eigen::Index i = first; i < points.rows(); ++i) {
    const double n = static_cast<double>(i - first + 1);
    const double a = std::fmod(shift_a + n / kPlastic, 1.0);
    const double b = std::fmod(shift_b + n / (kPlastic * kPlastic), 1.0);
    const double radius = std::sqrt(inner + (outer - inner) * a);
    points.row(i) = radius * Vec2(std::cos(2 * kPi * b), std::sin(2 * kPi * b));
  }
}

/// Drops the triangles inside of the clamp circle, which have all corners on it.
Triangles annulus_triangles(const Points2& points, int first_clamp, int first_inside) {
  const Triangles all = delaunay(points);
  Triangles kept(all.rows(), 3);
  int count = 0;
  for (int t = 0; t < all.rows(); ++t) {
    const bool on_support =
        (all.row(t).array() >= first_clamp).all() && (all.row(t).array() < first_inside).all();
    if (!on_support) kept.row(count++) = all.row(t);
  }
  return kept.topRows(count);
}

Vec2 circumcentre(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 p = b - a, q = c - a;
  const double d = 2 * (p.x() * q.y() - p.y() * q.x());
  return a + Vec2(q.y() * p.squaredNorm() - p.y() * q.squaredNorm(),
                  p.x() * q.squaredNorm() - q.x() * p.squaredNorm()) /
                 d;
}

/// One Lloyd step: every inside point moves to the centroid of its Voronoi cell, summed over signed
/// triangles (point, circumcentre, midpoint of an edge).
void relax(Points2& points, int first_clamp, int first_inside, const Scene& scene, double margin) {
  const Triangles triangles = annulus_triangles(points, first_clamp, first_inside);
  VecX area = VecX::Zero(points.rows());
  Points2 moment = Points2::Zero(points.rows(), 2);
  for (int t = 0; t < triangles.rows(); ++t) {
    Vec2 corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = points.row(triangles(t, k));
    const Vec2 centre = circumcentre(corner[0], corner[1], corner[2]);
    for (int k = 0; k < 3; ++k) {
      const Vec2& p = corner[k];
      const auto add = [&](const Vec2& a, const Vec2& b) {
        const double signed_area = ((a - p).x() * (b - p).y() - (a - p).y() * (b - p).x()) / 2;
        area[triangles(t, k)] += signed_area;
        moment.row(triangles(t, k)) += signed_area * (p + a + b).transpose() / 3;
      };
      add((p + corner[(k + 1) % 3]) / 2, centre);
      add(centre, (p + corner[(k + 2) % 3]) / 2);
    }
  }
  for (Eigen::Index i = first_inside; i < points.rows(); ++i) {
    if (!(area[i] > 0)) continue;
    Vec2 target = moment.row(i).transpose() / area[i];
    const double radius = target.norm();
    target *=
        std::clamp(radius, scene.support_radius + margin, scene.specimen_radius - margin) / radius;
    points.row(i) = target;
  }
}

/// The fixed ring: one triangle inside of every clamp edge, as high as the one outside, and the
/// triangles that fill the gaps between them. Appends the ring's inner vertices.
void add_fixed_ring(Points2& points, Triangles& triangles, int first_clamp, int clamp_count) {
  std::vector<int> apex(static_cast<size_t>(clamp_count), -1);
  const auto on_clamp = [&](int v) { return v >= first_clamp && v < first_clamp + clamp_count; };
  for (int t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
      // outside of the circle the edge runs clockwise around the axis
      if (on_clamp(a) && on_clamp(b) && (a - first_clamp) == (b - first_clamp + 1) % clamp_count)
        apex[static_cast<size_t>(b - first_clamp)] = triangles(t, (k + 2) % 3);
    }
  const int first_inner = static_cast<int>(points.rows());
  const Eigen::Index first_new = triangles.rows();
  points.conservativeResize(first_inner + clamp_count, 2);
  triangles.conservativeResize(first_new + 2 * clamp_count, 3);
  for (int i = 0; i < clamp_count; ++i) {
    const int next = (i + 1) % clamp_count;
    const int a = first_clamp + i, b = first_clamp + next;
    const int outer = apex[static_cast<size_t>(i)];
    if (outer < 0) throw std::runtime_error("disc mesh: the clamp circle is not made of edges");
    const Vec2 p = points.row(a), q = points.row(b), r = points.row(outer);
    const Vec2 along = (q - p).normalized(), outward(along.y(), -along.x());
    points.row(first_inner + i) = (p + q) / 2 - outward * (r - p).dot(outward);
    triangles.row(first_new + 2 * i) << a, b, first_inner + i;
    triangles.row(first_new + 2 * i + 1) << b, first_inner + next, first_inner + i;
  }
}

}  // namespace

Mesh make_disc_mesh(const Scene& scene, const DiscMeshOptions& options) {
  validate(scene);
  if (options.vertices < kMinimumVertices)
    throw std::invalid_argument("mesh vertices = " + std::to_string(options.vertices) +
                                ": must be at least " + std::to_string(kMinimumVertices));
  const double h = edge_length_for(scene, options.vertices);
  const Counts counts = counts_for(scene, h, options.vertices);
  const double row_height = std::sqrt(3.0) / 2 * h;
  const int first_clamp = counts.rim, first_inside = counts.rim + counts.clamp;

  Random random(options.seed);
  Points2 points(first_inside + counts.inside, 2);
  set_circle(points, 0, counts.rim, scene.specimen_radius, random.uniform());
  set_circle(points, first_clamp, counts.clamp, scene.support_radius, random.uniform());
  set_inside(points, first_inside, scene, 0.5 * row_height, random);
  for (int i = 0; i < kLloydIterations; ++i)
    relax(points, first_clamp, first_inside, scene, 0.6 * row_height);

  Triangles triangles = annulus_triangles(points, first_clamp, first_inside);
  add_fixed_ring(points, triangles, first_clamp, counts.clamp);

  const Eigen::Rotation2Dd turn(options.rotation);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    points.row(i) = (turn * Vec2(points.row(i))).transpose();

  std::vector<std::uint8_t> fixed(static_cast<size_t>(points.rows()), 0);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    fixed[static_cast<size_t>(i)] =
        (i >= first_clamp && i < first_inside) || i >= first_inside + counts.inside;
  return make_mesh(std::move(points), std::move(triangles), std::move(fixed),
                   options.clamp_wing_factor);
}

}  // namespace drape
