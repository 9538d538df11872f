#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/drape_protocol.h"
#include "core/self_intersection.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

VecX state_of(std::initializer_list<Vec3> points) {
  VecX x(3 * static_cast<Eigen::Index>(points.size()));
  Eigen::Index i = 0;
  for (const Vec3& point : points) x.segment<3>(3 * i++) = point;
  return x;
}

const Triangles& two_apart() {
  static const Triangles triangles = (Triangles(2, 3) << 0, 1, 2, 3, 4, 5).finished();
  return triangles;
}

/// A triangle in z = 0 and one that stands over it, the lowest corner at `low`.
VecX standing_over(double low) {
  return state_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.3, low}, {0.3, 0.2, 1}, {0.1, 0.4, 1}});
}

/// Whether the segment p q meets the triangle, by the solution of p + t (q - p) = a + u (b - a) +
/// v (c - a): another route than the signs of volumes.
bool meets(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  Mat3 A;
  A << q - p, a - b, a - c;
  const Vec3 solution = A.fullPivLu().solve(a - p);
  const double t = solution[0], u = solution[1], v = solution[2];
  return t > 0 && t < 1 && u > 0 && v > 0 && u + v < 1;
}

/// All pairs without a common vertex, each tested by each of its six edges.
Pairs every_pair(const Triangles& T, const VecX& x) {
  const auto edge_meets = [&](Eigen::Index i, Eigen::Index j) {
    for (int k = 0; k < 3; ++k)
      if (meets(position(x, T(i, k)), position(x, T(i, (k + 1) % 3)), position(x, T(j, 0)),
                position(x, T(j, 1)), position(x, T(j, 2))))
        return true;
    return false;
  };
  Pairs pairs;
  for (Eigen::Index i = 0; i < T.rows(); ++i)
    for (Eigen::Index j = i + 1; j < T.rows(); ++j) {
      bool common = false;
      for (int k = 0; k < 9; ++k) common |= T(i, k / 3) == T(j, k % 3);
      if (!common && (edge_meets(i, j) || edge_meets(j, i)))
        pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
    }
  return pairs;
}

TEST(SelfIntersection, ACornerBelowOrAboveThePlane) {
  for (const double depth : {1e-15, 1e-9, 1e-3, 0.5}) {  // 1e-15 of the size is seen
    EXPECT_EQ(self_intersections(two_apart(), standing_over(-depth)).disjoint, (Pairs{{0, 1}}));
    EXPECT_EQ(self_intersections(two_apart(), standing_over(depth)).count(), 0);
  }
  EXPECT_EQ(self_intersections(two_apart(), standing_over(0)).count(), 0) << "a touch";
}

TEST(SelfIntersection, BesideTheTriangleIsNoCrossing) {
  VecX x = standing_over(-0.1);
  for (int v = 3; v < 6; ++v) x[3 * v] += 0.6;  // beyond the hypotenuse, boxes overlapping
  EXPECT_EQ(self_intersections(two_apart(), x).count(), 0);
}

TEST(SelfIntersection, OneThroughAnEdgeOfTheOther) {
  // the standing triangle cuts the edge x = 0, so that each has an edge through the other
  VecX x = standing_over(-0.2);
  for (int v = 3; v < 6; ++v) x[3 * v] -= 0.2;
  EXPECT_EQ(self_intersections(two_apart(), x).disjoint, (Pairs{{0, 1}}));
}

TEST(SelfIntersection, CoplanarOverlapIsNotReported) {
  const VecX x =
      state_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0.1, 0}, {1.1, 0.1, 0}, {0.1, 1.1, 0}});
  EXPECT_EQ(self_intersections(two_apart(), x).count(), 0);
}

TEST(SelfIntersection, NearlyCoplanarIsDecidedByTheCoordinates) {
  // two sheets with slopes that differ by 1e-10 and cross along x = 0
  const double tilt = 1e-10;
  const auto sheet = [&](double shift) {
    return state_of({{-1, -1, 0},
                     {1, -1, 0},
                     {0, 1, 0},
                     {-1 + shift, -0.9, -tilt},
                     {1 + shift, -0.9, tilt},
                     {shift, 1.1, 0}});
  };
  EXPECT_EQ(self_intersections(two_apart(), sheet(0)).count(), 1);
  VecX lifted = sheet(0);
  for (int v = 3; v < 6; ++v) lifted[3 * v + 2] += 2 * tilt;
  EXPECT_EQ(self_intersections(two_apart(), lifted).count(), 0);
}

TEST(SelfIntersection, TrianglesWithACommonVertex) {
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 4, 3, 0;
  // the far edge 3 4 of the second passes through the first, or beyond its far edge
  const auto fan = [](double reach) {
    return state_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {reach, reach, 0.3}, {reach, reach, -0.2}});
  };
  const SelfIntersections crossing = self_intersections(triangles, fan(0.3));
  EXPECT_EQ(crossing.adjacent, (Pairs{{0, 1}}));
  EXPECT_TRUE(crossing.disjoint.empty());
  // here it is the first one's far edge that passes through the second
  EXPECT_EQ(self_intersections(triangles, fan(0.8)).adjacent, (Pairs{{0, 1}}));
  EXPECT_EQ(self_intersections(triangles, fan(-0.3)).count(), 0);
}

TEST(SelfIntersection, TrianglesWithACommonEdgeAreNotTested) {
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 1, 0, 3;
  const VecX x = state_of({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 0.9, 1e-3}});
  EXPECT_EQ(self_intersections(triangles, x).count(), 0);
}

TEST(SelfIntersection, RandomTrianglesAgainstEveryPair) {
  Random random(3);
  const int count = 200;
  Triangles triangles(count, 3);
  VecX x(9 * count);
  for (int t = 0; t < count; ++t) {
    const Vec3 centre(random.uniform(), random.uniform(), random.uniform());
    for (int k = 0; k < 3; ++k) {
      triangles(t, k) = 3 * t + k;
      for (int c = 0; c < 3; ++c) x[9 * t + 3 * k + c] = centre[c] + random.uniform(-0.2, 0.2);
    }
  }
  const Pairs expected = every_pair(triangles, x);
  EXPECT_GT(expected.size(), 100u);
  EXPECT_EQ(self_intersections(triangles, x).disjoint, expected);
}

TEST(SelfIntersection, ADiscFlatFoldedAndThroughItself) {
  const Mesh mesh = disc(300)->mesh();
  EXPECT_EQ(self_intersections(mesh.triangles, flat_state(mesh)).count(), 0);
  EXPECT_EQ(self_intersections(mesh.triangles, folded_state(mesh, kCusick, 6, 0)).count(), 0);
  // rolled on a cylinder with a gap
  EXPECT_EQ(self_intersections(mesh.triangles, cylinder(mesh, 6.0 / 0.3, 0)).count(), 0);
  VecX x = flat_state(mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const double u = mesh.rest_uv(v, 0) / 0.15;  // a loop: (u^2, u^3 - u/2) crosses itself
    x[3 * v] = 0.1 * u * u;
    x[3 * v + 2] = 0.1 * (u * u * u - 0.5 * u);
  }
  const SelfIntersections loop = self_intersections(mesh.triangles, x);
  EXPECT_GT(loop.disjoint.size(), 10u);
  EXPECT_EQ(loop.disjoint, every_pair(mesh.triangles, x));
}

TEST(SelfIntersection, RefusesAStateThatIsNotFinite) {
  VecX x = standing_over(1);
  x[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(self_intersections(two_apart(), x), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
