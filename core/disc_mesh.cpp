#include "core/disc_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/lloyd.h"
#include "core/random.h"

namespace drape {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kMinimumVertices = 200;

/// How many vertices go where for edges of length h.
struct Counts {
  int rim, clamp, inside;
};

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
    const double inside = inside_count(annulus, h, rim + clamp);
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

/// Uniform points in the open annulus.
void set_inside(Points2& points, int first, const Scene& scene, double margin, Random& random) {
  const double inner = std::pow(scene.support_radius + margin, 2);
  const double outer = std::pow(scene.specimen_radius - margin, 2);
  for (Eigen::Index i = first; i < points.rows(); ++i) {
    const Vec2 p = uniform_point(random);
    const double radius = std::sqrt(inner + (outer - inner) * p.x());
    points.row(i) = radius * Vec2(std::cos(2 * kPi * p.y()), std::sin(2 * kPi * p.y()));
  }
}

/// The annulus; the triangles inside of the clamp circle have all corners on it.
MeshRegion annulus(const Scene& scene, int first_clamp, int first_inside, double margin) {
  const double low = scene.support_radius + margin, high = scene.specimen_radius - margin;
  return {first_inside,
          [=](const Eigen::RowVector3i& triangle) {
            return (triangle.array() < first_clamp).any() ||
                   (triangle.array() >= first_inside).any();
          },
          [=](const Vec2& p) -> Vec2 {
            const double radius = p.norm();
            return p * (std::clamp(radius, low, high) / radius);
          }};
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
  const MeshRegion region = annulus(scene, first_clamp, first_inside, 0.6 * row_height);
  relax(points, region);
  Triangles triangles = region_triangles(points, region);
  add_fixed_row(points, triangles, first_clamp, counts.clamp, true);

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
