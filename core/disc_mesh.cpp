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

/// The length of edges at a distance from the clamp line, over that at the rim.
struct Grading {
  double at(double distance) const {
    // short in the first twelfth of the overhang, growing until 5/12 of it
    const double grown = std::clamp(3 * distance / overhang - 0.25, 0.0, 1.0);
    return 1 + (1 / refinement - 1) * (1 - grown);
  }
  double refinement, overhang;
};

/// How many vertices go where. The vertices of the fixed ring are as many as those on the clamp.
struct Counts {
  double rim, clamp, inside;
  double total() const { return inside + rim + 2 * clamp; }
};

/// The area of the annulus as edges count it, by the midpoint rule over rings of one width.
double graded_area(const Scene& scene, const Grading& grading) {
  constexpr int kRings = 1000;
  double plain = 0, graded = 0;
  for (int i = 0; i < kRings; ++i) {
    const double distance = (i + 0.5) / kRings * grading.overhang;
    const double radius = scene.support_radius + distance;
    plain += radius;
    graded += radius / std::pow(grading.at(distance), 2);
  }
  const double area =
      kPi * (std::pow(scene.specimen_radius, 2) - std::pow(scene.support_radius, 2));
  return area * (graded / plain);
}

/// For edges of length h at the rim.
Counts counts_for(const Scene& scene, const Grading& grading, double area, double h) {
  const double rim = 2 * kPi * scene.specimen_radius / h;
  const double clamp = 2 * kPi * scene.support_radius / (h * grading.at(0));
  return {rim, clamp, inside_count(area, h, rim + clamp)};
}

double edge_length_for(const Scene& scene, const Grading& grading, double area, int total) {
  double low = 1e-3 * scene.specimen_radius, high = scene.specimen_radius;
  for (int i = 0; i < 100; ++i) {
    const double h = (low + high) / 2;
    (counts_for(scene, grading, area, h).total() > total ? low : high) = h;
  }
  return low;
}

void set_circle(Points2& points, int first, int count, double radius, double phase) {
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * (i + phase) / count;
    points.row(first + i) = radius * Vec2(std::cos(angle), std::sin(angle));
  }
}

/// Radii that vertices inside may have.
struct Radii {
  double low, high;
};

/// Random points in the open annulus, as many on an area as edges ask for.
void set_inside(Points2& points, int first, const Scene& scene, const Grading& grading,
                const Radii& radii, Random& random) {
  const double inner = radii.low * radii.low, outer = radii.high * radii.high;
  for (Eigen::Index i = first; i < points.rows();) {
    const Vec2 p = uniform_point(random);
    const double radius = std::sqrt(inner + (outer - inner) * p.x());
    const double share = std::pow(grading.at(0) / grading.at(radius - scene.support_radius), 2);
    if (share < 1 && random.uniform() > share) continue;
    points.row(i++) = radius * Vec2(std::cos(2 * kPi * p.y()), std::sin(2 * kPi * p.y()));
  }
}

/// The annulus; the triangles inside of the clamp circle have all corners on it.
MeshRegion annulus(const Scene& scene, const Grading& grading, int first_clamp, int first_inside,
                   const Radii& radii) {
  return {first_inside,
          [=](const Eigen::RowVector3i& triangle) {
            return (triangle.array() < first_clamp).any() ||
                   (triangle.array() >= first_inside).any();
          },
          [=](const Vec2& p) -> Vec2 {
            const double radius = p.norm();
            return p * (std::clamp(radius, radii.low, radii.high) / radius);
          },
          [=](const Vec2& p) { return std::pow(grading.at(p.norm() - scene.support_radius), -4); }};
}

}  // namespace

Mesh make_disc_mesh(const Scene& scene, const DiscMeshOptions& options) {
  validate(scene);
  if (options.vertices < kMinimumVertices)
    throw std::invalid_argument("mesh vertices = " + std::to_string(options.vertices) +
                                ": must be at least " + std::to_string(kMinimumVertices));
  if (!(options.clamp_refinement >= 1 && options.clamp_refinement <= 4))
    throw std::invalid_argument(
        "mesh clamp_refinement = " + std::to_string(options.clamp_refinement) +
        ": must be between 1 and 4");
  const Grading grading{options.clamp_refinement, scene.specimen_radius - scene.support_radius};
  const double area = graded_area(scene, grading);
  const double h = edge_length_for(scene, grading, area, options.vertices);
  const Counts counts = counts_for(scene, grading, area, h);
  const auto rim = static_cast<int>(std::lround(counts.rim));
  const auto clamp = static_cast<int>(std::lround(counts.clamp));
  const int first_clamp = rim, first_inside = rim + clamp;
  const int first_back = options.vertices - clamp;
  const auto radii = [&](double rows) -> Radii {
    const double row_height = std::sqrt(3.0) / 2 * h;
    return {scene.support_radius + rows * grading.at(0) * row_height,
            scene.specimen_radius - rows * row_height};
  };

  Random random(options.seed);
  Points2 points(first_back, 2);
  set_circle(points, 0, rim, scene.specimen_radius, random.uniform());
  set_circle(points, first_clamp, clamp, scene.support_radius, random.uniform());
  set_inside(points, first_inside, scene, grading, radii(0.5), random);
  const MeshRegion region = annulus(scene, grading, first_clamp, first_inside, radii(0.6));
  relax(points, region);
  Triangles triangles = region_triangles(points, region);
  add_fixed_row(points, triangles, first_clamp, clamp, true);

  const Eigen::Rotation2Dd turn(options.rotation);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    points.row(i) = (turn * Vec2(points.row(i))).transpose();

  std::vector<std::uint8_t> fixed(static_cast<size_t>(points.rows()), 0);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    fixed[static_cast<size_t>(i)] = (i >= first_clamp && i < first_inside) || i >= first_back;
  return make_mesh(std::move(points), std::move(triangles), std::move(fixed),
                   options.clamp_wing_factor);
}

}  // namespace drape
