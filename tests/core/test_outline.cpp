#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <vector>

#include "core/outline.h"
#include "core/random.h"
#include "tests/support/laid_out_cloth.h"

namespace drape {
namespace {

using namespace drape::test;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

Vec2 corner(const Outline& outline, int k) { return outline.points.row(k % outline.size()); }

bool is_simple(const Outline& outline) {
  const int n = outline.size();
  for (int i = 0; i < n; ++i)
    for (int j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const Vec2 a = corner(outline, i), b = corner(outline, i + 1);
      const Vec2 c = corner(outline, j), d = corner(outline, j + 1);
      if ((cross(b - a, c - a) > 0) != (cross(b - a, d - a) > 0) &&
          (cross(d - c, a - c) > 0) != (cross(d - c, b - c) > 0))
        return false;
    }
  return true;
}

/// Whether p lies inside of the outline or within `margin` of it.
bool contains(const Outline& outline, const Vec2& p, double margin) {
  bool inside = false;
  for (int k = 0; k < outline.size(); ++k) {
    const Vec2 a = corner(outline, k), r = corner(outline, k + 1) - a;
    const double t = std::clamp((p - a).dot(r) / r.squaredNorm(), 0.0, 1.0);
    if ((a + t * r - p).norm() <= margin) return true;
    if ((a.y() > p.y()) != (a.y() + r.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / r.y() * r.x())
      inside = !inside;
  }
  return inside;
}

/// Area of the union of triangles and disc with its holes filled, counted on a grid of pixels.
double raster_area(const Mesh& mesh, const VecX& x) {
  constexpr int kPixels = 600;
  constexpr double kWidth = 0.36, kSize = kWidth / kPixels;
  std::vector<char> seen(kPixels * kPixels, 0);
  const auto centre = [](int i) { return (i + 0.5) * kSize - kWidth / 2; };
  const auto index = [](double at) { return static_cast<int>((at + kWidth / 2) / kSize); };
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    std::array<Vec2, 3> p;
    for (int j = 0; j < 3; ++j)
      p[static_cast<size_t>(j)] = position(x, mesh.triangles(t, j)).head<2>();
    const Vec2 low = p[0].cwiseMin(p[1]).cwiseMin(p[2]), high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
    for (int row = index(low.y()); row <= index(high.y()); ++row)
      for (int column = index(low.x()); column <= index(high.x()); ++column) {
        const Vec2 q(centre(column), centre(row));
        int left = 0;
        for (size_t j = 0; j < 3; ++j) left += cross(p[(j + 1) % 3] - p[j], q - p[j]) >= 0;
        if (left == 0 || left == 3) seen[static_cast<size_t>(row * kPixels + column)] = 1;
      }
  }
  for (int row = 0; row < kPixels; ++row)
    for (int column = 0; column < kPixels; ++column)
      if (std::hypot(centre(row), centre(column)) < kScene.support_radius)
        seen[static_cast<size_t>(row * kPixels + column)] = 1;
  // Flood the outside from a corner; what stays dry is the shadow with its holes.
  std::vector<int> front{0};
  int outside = 0;
  while (!front.empty()) {
    const int at = front.back();
    front.pop_back();
    if (seen[static_cast<size_t>(at)]) continue;
    seen[static_cast<size_t>(at)] = 1;
    ++outside;
    if (at % kPixels > 0) front.push_back(at - 1);
    if (at % kPixels < kPixels - 1) front.push_back(at + 1);
    if (at >= kPixels) front.push_back(at - kPixels);
    if (at < kPixels * (kPixels - 1)) front.push_back(at + kPixels);
  }
  return (kPixels * kPixels - outside) * kSize * kSize;
}

int count(const Outline& outline, OutlineCorner::Kind kind) {
  return static_cast<int>(
      std::count_if(outline.corners.begin(), outline.corners.end(),
                    [&](const OutlineCorner& corner) { return corner.kind == kind; }));
}

/// Turns the list of corners until it starts like the reference's (the farthest corner may have
/// become another one). False if the corners are not the same even then.
bool align(Outline& outline, const Outline& reference) {
  const auto same = [](const OutlineCorner& p, const OutlineCorner& q) {
    return p.kind == q.kind && p.vertices == q.vertices && p.support_edge == q.support_edge;
  };
  auto& corners = outline.corners;
  const auto first = std::find_if(corners.begin(), corners.end(), [&](const OutlineCorner& at) {
    return same(at, reference.corners.front());
  });
  const Eigen::Index shift = first - corners.begin(), n = outline.size();
  if (shift == n) return false;
  std::rotate(corners.begin(), first, corners.end());
  const Points2 points = outline.points;
  for (Eigen::Index k = 0; k < n; ++k) outline.points.row(k) = points.row((k + shift) % n);
  return std::equal(corners.begin(), corners.end(), reference.corners.begin(),
                    reference.corners.end(), same);
}

VecX random_direction(Eigen::Index size, std::uint64_t seed) {
  Random random(seed);
  VecX direction(size);
  for (double& component : direction) component = random.uniform(-1, 1);
  return direction;
}

TEST(Outline, OfTheFlatClothIsItsRim) {
  const Mesh mesh = annulus(72, 6);
  const VecX x = state(mesh, flat);
  const Outline outline = trace_outline(mesh, kScene, x);
  ASSERT_EQ(outline.size(), 72);
  EXPECT_EQ(count(outline, OutlineCorner::Kind::vertex), 72);
  const int first = outline.corners[0].vertices[0] - mesh.boundary[0];
  for (int k = 0; k < 72; ++k) {
    const int vertex = mesh.boundary[static_cast<size_t>((first + k) % 72)];
    EXPECT_EQ(outline.corners[static_cast<size_t>(k)].vertices[0], vertex);
    // Vertices are offset by up to 1e-13 m so that no two coincide.
    EXPECT_LE((outline.points.row(k) - mesh.rest_uv.row(vertex)).norm(), 2e-13);
  }
  const double exact = 72 / 2.0 * std::sin(2 * std::numbers::pi / 72) * 0.15 * 0.15;
  EXPECT_NEAR(area(outline.points), exact, 1e-13);  // the offset times the perimeter
}

TEST(Outline, EnclosesTheShadowAndNothingElse) {
  const Mesh mesh = annulus(96, 10);
  for (const auto& [name, shape] : all_shapes()) {
    SCOPED_TRACE(name);
    const VecX x = state(mesh, shape);
    const Outline outline = trace_outline(mesh, kScene, x);
    EXPECT_TRUE(is_simple(outline));
    for (int i = 0; i < mesh.vertex_count(); ++i)
      EXPECT_TRUE(contains(outline, position(x, i).head<2>(), 1e-12)) << "vertex " << i;
    // About 2500 border pixels of .36 mm^2, each wrong by .3 of it: 5e-6 m^2 at one sigma.
    const double traced = area(outline.points);
    EXPECT_GT(traced, 0);
    EXPECT_NEAR(traced, raster_area(mesh, x), 2e-5);
  }
}

TEST(Outline, HasTheKindsOfCornersThatItsShapeAsksFor) {
  using Kind = OutlineCorner::Kind;
  const Mesh mesh = annulus(96, 10);
  const auto trace = [&](const Shape& shape) {
    return trace_outline(mesh, kScene, state(mesh, shape));
  };
  EXPECT_EQ(count(trace(lobes), Kind::vertex), 96);
  EXPECT_EQ(trace(lobes).size(), 96);

  const Outline folded = trace(swung);
  EXPECT_GE(count(folded, Kind::crossing), 7);
  EXPECT_EQ(count(folded, Kind::support), 0);

  // The rim of the bulging cloth is hidden behind its folds.
  const std::set<int> rim(mesh.boundary.begin(), mesh.boundary.end());
  for (const OutlineCorner& at : trace(bulging).corners)
    if (at.kind == Kind::vertex) {
      EXPECT_FALSE(rim.contains(at.vertices[0]));
    }

  const Outline between = trace(tucked);
  EXPECT_GE(count(between, Kind::support), 6);
  int on_support_edge = 0;
  for (const OutlineCorner& at : between.corners) {
    if (at.kind != Kind::crossing) continue;
    if (at.vertices[0] >= 0 && at.vertices[2] >= 0) continue;
    ++on_support_edge;
    EXPECT_NEAR(at.support_edge[0].norm(), kScene.support_radius, 1e-15);
    EXPECT_NEAR(at.support_edge[1].norm(), kScene.support_radius, 1e-15);
  }
  EXPECT_GE(on_support_edge, 12);
}

TEST(Outline, OfAHiddenClothIsTheSupport) {
  const Mesh mesh = annulus(96, 10);
  const Outline outline = trace_outline(mesh, kScene, state(mesh, hidden));
  const double circle = std::numbers::pi * 0.09 * 0.09;
  // 1440 corners: 3.2e-6 of the circle is missing, a few 1e-7 of which the clamped vertices add.
  EXPECT_NEAR(area(outline.points), circle, 4e-6 * circle);
  EXPECT_NEAR(drape_coefficient(kScene, area(outline.points)), 0, 3e-6);
}

TEST(Outline, StandsASkirtThatHangsStraightDown) {
  // All circles of vertices project onto one another exactly, all triangles are vertical.
  const Mesh mesh = annulus(96, 10);
  VecX x = state(mesh, flat);
  for (int i = 2 * 96; i < mesh.vertex_count(); ++i)
    x.segment<3>(3 * i) = Vec3(x[3 * (i % 96 + 96)], x[3 * (i % 96 + 96) + 1], -0.01 * (i / 96));
  const Outline outline = trace_outline(mesh, kScene, x);
  const double circle = std::numbers::pi * 0.09 * 0.09;
  EXPECT_NEAR(area(outline.points), circle, 4e-6 * circle);
}

TEST(Outline, OfAClothOffTheAxis) {
  // A blown-away lobe: the cloth's farthest corner and the support's visible part lie apart.
  const Mesh mesh = annulus(96, 10);
  const VecX x = state(mesh, [](double s, double alpha) {
    return Vec3(polar(0.09 - 0.02 * s, alpha, -0.05 * s) + Vec3(0.06 * s, 0, 0));
  });
  const Outline outline = trace_outline(mesh, kScene, x);
  EXPECT_TRUE(is_simple(outline));
  EXPECT_NEAR(area(outline.points), raster_area(mesh, x), 2e-5);
  EXPECT_GT(count(outline, OutlineCorner::Kind::support), 300);
}

TEST(Outline, VelocitiesMatchCentralDifferences) {
  const Mesh mesh = annulus(96, 10);
  for (const auto& [name, shape] : all_shapes()) {
    SCOPED_TRACE(name);
    const VecX x = state(mesh, shape);
    VecX dx = random_direction(x.size(), 7);
    for (int i = 0; i < mesh.vertex_count(); ++i)
      if (mesh.fixed[static_cast<size_t>(i)]) dx.segment<3>(3 * i).setZero();
    const Outline outline = trace_outline(mesh, kScene, x);
    const Points2 exact = push_forward(outline, x, dx);
    double best = std::numeric_limits<double>::infinity();
    for (double step : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
      Outline ahead = trace_outline(mesh, kScene, x + step * dx);
      Outline behind = trace_outline(mesh, kScene, x - step * dx);
      if (!align(ahead, outline) || !align(behind, outline)) continue;
      best = std::min(best, ((ahead.points - behind.points) / (2 * step) - exact).norm());
    }
    EXPECT_LE(best, 1e-7 * exact.norm());  // rounding 1e-17 / step against truncation
  }
}

TEST(Outline, PullBackIsTheTransposeOfPushForward) {
  const Mesh mesh = annulus(96, 10);
  for (const auto& [name, shape] : all_shapes()) {
    SCOPED_TRACE(name);
    const VecX x = state(mesh, shape), dx = random_direction(x.size(), 5);
    const Outline outline = trace_outline(mesh, kScene, x);
    const VecX weights = random_direction(2 * outline.size(), 9);
    const Points2 dL_dpoints = Eigen::Map<const Points2>(weights.data(), outline.size(), 2);
    const Points2 rate = push_forward(outline, x, dx);
    const VecX gradient = pull_back(outline, x, dL_dpoints);
    EXPECT_NEAR(dL_dpoints.cwiseProduct(rate).sum(), gradient.dot(dx),
                1e-13 * gradient.cwiseAbs().sum());  // rounding
    for (int i = 0; i < mesh.vertex_count(); ++i) EXPECT_EQ(gradient[3 * i + 2], 0);
  }
}

TEST(Outline, AreaIsTheIntegralOfItsDerivativeAcrossChangesOfTheCorners) {
  // From star-shaped lobes to overhanging ones, and until the support shows.
  const Mesh mesh = annulus(96, 10);
  const VecX from = state(mesh, lobes),
             to = state(mesh, tucked) - 0.4 * (from - state(mesh, swung));
  const int steps = 400;
  double integral = 0, previous_rate = 0;
  int changes = 0;
  Outline previous;
  for (int k = 0; k <= steps; ++k) {
    const VecX x = from + (to - from) * k / steps;
    Outline outline = trace_outline(mesh, kScene, x);
    const double rate =
        area_gradient(outline.points).cwiseProduct(push_forward(outline, x, to - from)).sum();
    if (k > 0) {
      integral += (previous_rate + rate) / 2 / steps;
      changes += !align(outline, previous);
    }
    previous_rate = rate;
    previous = outline;
  }
  EXPECT_GE(changes, 50);
  const double difference = area(previous.points) - area(trace_outline(mesh, kScene, from).points);
  // The trapezoidal rule's error, 1 / steps^2 times the changes of slope; 1e-2 m^2 is the change.
  EXPECT_NEAR(integral, difference, 1e-7);
}

TEST(Outline, RefusesWhatIsNoState) {
  const Mesh mesh = annulus(24, 3);
  VecX x = state(mesh, flat);
  EXPECT_THROW(trace_outline(mesh, kScene, x.head(x.size() - 3)), std::invalid_argument);
  Mesh without_rim = mesh;
  without_rim.boundary.clear();
  EXPECT_THROW(trace_outline(without_rim, kScene, x), std::invalid_argument);
  x[30] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(trace_outline(mesh, kScene, x), std::runtime_error);
}

TEST(Outline, RefusesABoundaryThatCannotBeTraced) {
  // A rim that visits one vertex only: all corners coincide.
  Mesh mesh = annulus(24, 3);
  mesh.wings.clear();
  VecX x = VecX::Zero(3 * mesh.vertex_count());
  mesh.boundary.assign(3, mesh.boundary[0]);
  x.array() += 0.2;
  EXPECT_THROW(trace_outline(mesh, kScene, x), std::runtime_error);
}

Points2 shifted_triangle(const Vec2& shift) {
  Points2 triangle(3, 2);
  triangle << 0, 0, 3, 0, 0, 6;
  triangle.rowwise() += shift.transpose();
  return triangle;
}

TEST(Polygon, AreaAndCentroidOfATriangleAnywhere) {
  for (const Vec2& shift : {Vec2(0, 0), Vec2(-7, 1000)}) {
    const Points2 triangle = shifted_triangle(shift);
    EXPECT_DOUBLE_EQ(area(triangle), 9);
    EXPECT_DOUBLE_EQ(area(triangle.colwise().reverse()), -9);
    EXPECT_LE((centroid(triangle) - shift - Vec2(1, 2)).norm(), 1e-12);  // rounding of 1000
  }
}

TEST(Polygon, AreaGradientMatchesCentralDifferences) {
  const VecX values = random_direction(26, 2), direction = random_direction(26, 3);
  const auto polygon = [&](double step) -> Points2 {
    const VecX moved = values + step * direction;
    return Eigen::Map<const Points2>(moved.data(), 13, 2);
  };
  const Points2 velocity = Eigen::Map<const Points2>(direction.data(), 13, 2);
  // The area is quadratic: central differences are exact but for rounding.
  EXPECT_NEAR(area_gradient(polygon(0)).cwiseProduct(velocity).sum(),
              (area(polygon(1)) - area(polygon(-1))) / 2, 1e-13);
}

TEST(Polygon, DrapeCoefficientRunsFromTheSupportToTheSpecimen) {
  EXPECT_NEAR(drape_coefficient(kScene, std::numbers::pi * 0.09 * 0.09), 0, 1e-15);
  EXPECT_NEAR(drape_coefficient(kScene, std::numbers::pi * 0.15 * 0.15), 1, 1e-15);
  EXPECT_NEAR(drape_coefficient(kScene, std::numbers::pi * 0.12 * 0.12), 63.0 / 144.0, 1e-15);
}

}  // namespace
}  // namespace drape
