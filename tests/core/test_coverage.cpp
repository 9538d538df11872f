#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/coverage.h"
#include "core/outline.h"
#include "core/random.h"

namespace drape {
namespace {

/// A rough star-shaped polygon, generic with respect to the pixels.
Points2 star(int corners, double mean_radius, const Vec2& centre, std::uint64_t seed) {
  Random random(seed);
  Points2 polygon(corners, 2);
  for (int k = 0; k < corners; ++k) {
    const double alpha = 2 * std::numbers::pi * (k + random.uniform(0, 0.8)) / corners;
    const double radius = mean_radius * random.uniform(0.6, 1.4);
    polygon.row(k) = centre + radius * Vec2(std::cos(alpha), std::sin(alpha));
  }
  return polygon;
}

Points2 rectangle(double left, double right, double bottom, double top) {
  Points2 polygon(4, 2);
  polygon << left, bottom, right, bottom, right, top, left, top;
  return polygon;
}

/// The part of a polygon with sign * coordinate[axis] >= sign * bound (Sutherland and Hodgman
/// 1974).
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, int axis, double sign, double bound) {
  std::vector<Vec2> kept;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double p_in = sign * (p[axis] - bound), q_in = sign * (q[axis] - bound);
    if (p_in >= 0) kept.push_back(p);
    if ((p_in >= 0) != (q_in >= 0)) kept.emplace_back(p + p_in / (p_in - q_in) * (q - p));
  }
  return kept;
}

/// Coverage by clipping the whole polygon to every pixel.
CoverageImage clipped_coverage(const Points2& polygon, const PixelGrid& grid) {
  std::vector<Vec2> corners;
  for (Eigen::Index k = 0; k < polygon.rows(); ++k) corners.emplace_back(polygon.row(k));
  CoverageImage image(grid.rows, grid.columns);
  const double h = grid.pixel_size;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Vec2 low = grid.origin + h * Vec2(column, grid.rows - 1 - row);
      std::vector<Vec2> part = clipped(clipped(corners, 0, 1, low.x()), 1, 1, low.y());
      part = clipped(clipped(part, 0, -1, low.x() + h), 1, -1, low.y() + h);
      double twice_area = 0;
      for (size_t k = 0; k < part.size(); ++k) {
        const Vec2 p = part[k] - low, q = part[(k + 1) % part.size()] - low;
        twice_area += p.x() * q.y() - p.y() * q.x();
      }
      image(row, column) = twice_area / (2 * h * h);
    }
  return image;
}

/// Polygons inside of the grid and over every border of it.
std::vector<Points2> awkward_polygons() {
  return {star(37, 0.06, {0.003, -0.002}, 1), star(9, 0.01, {0.01, 0.02}, 2),
          star(23, 0.05, {-0.08, 0.01}, 3),   star(23, 0.05, {0.08, 0.01}, 4),
          star(23, 0.05, {0.01, 0.08}, 5),    star(23, 0.05, {0.01, -0.08}, 6),
          star(400, 0.12, {0, 0}, 7),         star(15, 0.08, {0.07, -0.09}, 8)};
}

// 40 x 24 pixels of 5 mm about the axis.
const PixelGrid kGrid{24, 40, 5e-3, {-0.1, -0.06}};

TEST(Coverage, CentredGridCoversItsWidth) {
  const PixelGrid grid = centred_grid(256, 0.356);
  EXPECT_EQ(grid.rows, 256);
  EXPECT_EQ(grid.columns, 256);
  EXPECT_DOUBLE_EQ(grid.pixel_size * 256, 0.356);
  EXPECT_EQ(grid.origin, Vec2::Constant(-0.178));
  EXPECT_THROW(centred_grid(0, 1), std::invalid_argument);
  EXPECT_THROW(centred_grid(4, 0), std::invalid_argument);
  EXPECT_THROW(centred_grid(4, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

TEST(Coverage, OfARectangleIsReadOffItsSides) {
  const PixelGrid grid{3, 4, 1, Vec2::Zero()};
  const CoverageImage image = coverage(rectangle(0.5, 3, 0.75, 2.5), grid);
  CoverageImage expected(3, 4);
  expected << 0.25, 0.5, 0.5, 0,  // row 0 is the upper one, y in [2, 3]
      0.5, 1, 1, 0,               //
      0.125, 0.25, 0.25, 0;
  EXPECT_EQ(image, expected);  // binary fractions: exact
  EXPECT_EQ(coverage(rectangle(-9, 9, -9, 9), grid), CoverageImage::Ones(3, 4));
  EXPECT_EQ(coverage(rectangle(0, 4, 0, 3), grid), CoverageImage::Ones(3, 4));
  for (const Points2& outside : {rectangle(-2, -1, 0, 3), rectangle(4, 5, 0, 3),
                                 rectangle(0, 4, 3, 5), rectangle(0, 4, -2, 0)})
    EXPECT_EQ(coverage(outside, grid), CoverageImage::Zero(3, 4));
}

TEST(Coverage, EqualsThePolygonClippedToEveryPixel) {
  for (const Points2& polygon : awkward_polygons()) {
    const CoverageImage image = coverage(polygon, kGrid);
    // Coordinates are up to 40 pixels, of which the row sums of about 100 terms keep 1e-13.
    EXPECT_LE((image - clipped_coverage(polygon, kGrid)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_GE(image.minCoeff(), 0);
    EXPECT_LE(image.maxCoeff(), 1);
  }
}

TEST(Coverage, SumsUpToTheAreaOfAPolygonInsideTheGrid) {
  const PixelGrid grid = centred_grid(256, 0.356);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Points2 polygon = star(300, 0.11, {0.002, 0.001}, seed);
    const double exact = area(polygon);
    const double sum = coverage(polygon, grid).sum() * grid.pixel_size * grid.pixel_size;
    EXPECT_NEAR(sum, exact, 1e-14 * exact);  // rounding of 1e-16 a pixel, mostly averaged out
  }
}

TEST(Coverage, DerivativeMatchesCentralDifferences) {
  Random random(11);
  for (const Points2& polygon : awkward_polygons()) {
    CoverageImage weights(kGrid.rows, kGrid.columns);
    for (double& weight : weights.reshaped()) weight = random.uniform(-1, 1);
    Points2 direction(polygon.rows(), 2);
    for (double& component : direction.reshaped()) component = random.uniform(-1, 1);
    const double exact = pull_back(polygon, kGrid, weights).cwiseProduct(direction).sum();
    const auto loss = [&](double step) {
      return weights.cwiseProduct(coverage(polygon + step * direction, kGrid)).sum();
    };
    double best = std::numeric_limits<double>::infinity();
    for (double step : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8})
      best = std::min(best, std::abs((loss(step) - loss(-step)) / (2 * step) - exact));
    // Piecewise quadratic along the direction: no truncation error, 1e-13 / (step / pixel)
    // rounding.
    EXPECT_LE(best, 1e-8 * std::abs(exact) + 1e-9 / kGrid.pixel_size);
  }
}

TEST(Coverage, PushForwardIsTheTransposeOfPullBack) {
  const Points2 polygon = star(41, 0.1, {0.02, -0.01}, 6);
  Random random(3);
  CoverageImage weights(kGrid.rows, kGrid.columns);
  for (double& weight : weights.reshaped()) weight = random.uniform(-1, 1);
  Points2 velocity(polygon.rows(), 2);
  for (double& component : velocity.reshaped()) component = random.uniform(-1, 1);
  const double pulled = pull_back(polygon, kGrid, weights).cwiseProduct(velocity).sum();
  const CoverageImage rate = push_forward(polygon, kGrid, velocity);
  EXPECT_NEAR(weights.cwiseProduct(rate).sum(), pulled, 1e-13 * rate.cwiseAbs().sum());  // rounding
}

TEST(Coverage, DerivativeOfTheSumIsTheDerivativeOfTheArea) {
  const PixelGrid grid = centred_grid(64, 0.4);
  const Points2 polygon = star(41, 0.1, {0, 0}, 5);
  const Points2 pulled = pull_back(polygon, grid, CoverageImage::Ones(64, 64));
  const Points2 exact = area_gradient(polygon) / (grid.pixel_size * grid.pixel_size);
  EXPECT_LE((pulled - exact).norm(), 1e-13 * exact.norm());  // rounding
}

TEST(Coverage, AnEdgeOnAGridLineBelongsToOneOfThePixelsBesideIt) {
  // Moving the upper side of a rectangle by d adds d in every column, on either side of the line.
  const PixelGrid grid{4, 4, 1, Vec2::Zero()};
  for (double top : {1.999999, 2.0, 2.000001}) {
    const Points2 gradient = pull_back(rectangle(1, 3, 1, top), grid, CoverageImage::Ones(4, 4));
    EXPECT_DOUBLE_EQ(gradient(2, 1) + gradient(3, 1), 2);
  }
}

TEST(Coverage, RefusesPolygonsWithoutAnInside) {
  EXPECT_THROW(coverage(rectangle(3, 1, 1, 2), kGrid), std::invalid_argument);  // clockwise
  EXPECT_THROW(coverage(rectangle(1, 1, 1, 2), kGrid), std::invalid_argument);
  EXPECT_THROW(coverage(rectangle(1, std::numeric_limits<double>::infinity(), 1, 2), kGrid),
               std::invalid_argument);
}

TEST(Coverage, IntersectionOverUnion) {
  const PixelGrid grid{4, 4, 1, Vec2::Zero()};
  const CoverageImage a = coverage(rectangle(0, 2, 0, 2), grid);
  const CoverageImage b = coverage(rectangle(1, 3, 0, 2), grid);
  EXPECT_DOUBLE_EQ(intersection_over_union(a, a), 1);
  EXPECT_DOUBLE_EQ(intersection_over_union(a, b), 2.0 / 6.0);
  const CoverageImage empty = CoverageImage::Zero(4, 4);
  EXPECT_DOUBLE_EQ(intersection_over_union(a, empty), 0);
  EXPECT_THROW(intersection_over_union(empty, empty), std::invalid_argument);
  EXPECT_THROW(intersection_over_union(a, CoverageImage::Zero(3, 4)), std::invalid_argument);
}

}  // namespace
}  // namespace drape
