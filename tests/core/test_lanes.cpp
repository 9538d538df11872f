#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/lanes.h"
#include "core/random.h"

namespace drape::test {
namespace {

/// Distance in units in the last place of `expected`.
double ulps(double value, double expected) {
  if (value == expected) return std::signbit(value) == std::signbit(expected) ? 0 : 1e300;
  const double ulp = std::nextafter(std::abs(expected), std::numeric_limits<double>::infinity()) -
                     std::abs(expected);
  return std::abs(value - expected) / ulp;
}

double lane_atan2(double y, double x) {
  Lanes ys = 1.0, xs = 1.0;
  ys[kLanes - 1] = y;
  xs[kLanes - 1] = x;
  return atan2(ys, xs)[kLanes - 1];
}

TEST(Lanes, ArcTangentInAllQuadrants) {
  Random random(1);
  for (int i = 0; i < 100000; ++i) {
    const double y = random.uniform(-1, 1), x = random.uniform(-1, 1);
    EXPECT_LE(ulps(lane_atan2(y, x), std::atan2(y, x)), 2) << y << ", " << x;
    const double tilt = y * std::pow(10, random.uniform(-17, 1));  // nearly flat, nearly closed
    EXPECT_LE(ulps(lane_atan2(tilt, x), std::atan2(tilt, x)), 2) << tilt << ", " << x;
    EXPECT_LE(ulps(lane_atan2(x, tilt), std::atan2(x, tilt)), 2) << x << ", " << tilt;
  }
}

TEST(Lanes, ArcTangentOfZerosAndExtremes) {
  const std::vector<double> special = {0.0,    -0.0,  1.0,   -1.0,   1e-300, -1e-300,
                                       1e-150, 1e150, 1e300, -1e300, 5e-20,  M_SQRT2 - 1};
  for (const double y : special)
    for (const double x : special)
      EXPECT_LE(ulps(lane_atan2(y, x), std::atan2(y, x)), 2) << y << ", " << x;
}

TEST(Lanes, LoadsAndAddsVerticesLaneAfterLane) {
  PaddedState x(4, kLanes + 3);
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = static_cast<double>(i);
  int vertices[kLanes];
  for (int i = 0; i < kLanes; ++i) vertices[i] = (5 * i + 2) % (kLanes + 3);
  const Vec3Lanes p = positions(x, vertices);
  for (size_t i = 0; i < kLanes; ++i) {
    EXPECT_EQ(p.x[i], x(0, vertices[i]));
    EXPECT_EQ(p.y[i], x(1, vertices[i]));
    EXPECT_EQ(p.z[i], x(2, vertices[i]));
  }
  PaddedState sum = PaddedState::Zero(4, kLanes + 3), expected = sum;
  vertices[0] = vertices[kLanes - 1];  // one vertex twice
  add_at(sum, vertices, p);
  for (size_t i = 0; i < kLanes; ++i)
    expected.col(vertices[i]).head<3>() += Vec3(p.x[i], p.y[i], p.z[i]);
  EXPECT_EQ(sum, expected);
}

}  // namespace
}  // namespace drape::test
