#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/mesh.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// A unit square of two triangles and a third triangle to its right.
struct Parts {
  Points2 uv{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}};
  Triangles triangles{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
  std::vector<std::uint8_t> fixed{0, 0, 0, 0, 0};

  Mesh mesh() const { return make_mesh(uv, triangles, fixed); }
  std::string refusal() const {
    try {
      mesh();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  }
};

#define EXPECT_REFUSAL(parts, text) \
  EXPECT_NE((parts).refusal().find(text), std::string::npos) << (parts).refusal()

TEST(Mesh, WingHeightsAndWeights) {
  const Mesh mesh = one_wing(0.012, 0.009, 0.015, 0.4);
  ASSERT_EQ(mesh.wings.size(), 1u);
  const Wing& wing = mesh.wings[0];
  EXPECT_EQ(wing.vertices, (std::array<int, 4>{0, 1, 2, 3}));  // apex to the left first
  EXPECT_NEAR(wing.weight, 12.0 / 9 + 12.0 / 15, 1e-14);
  EXPECT_NEAR(wing.mean_height, 0.012, 1e-16);
  EXPECT_FALSE(wing.on_clamp_line);
}

TEST(Mesh, PhiIsTheBendingDirectionFoldedIntoTheFirstQuadrant) {
  // the bending direction is perpendicular to the edge
  const std::pair<double, double> expected[] = {{0, kPi / 2},           {kPi / 2, 0},
                                                {kPi / 4, kPi / 4},     {-kPi / 4, kPi / 4},
                                                {3 * kPi / 4, kPi / 4}, {0.2, kPi / 2 - 0.2},
                                                {-0.2, kPi / 2 - 0.2},  {kPi - 0.2, kPi / 2 - 0.2},
                                                {kPi / 2 + 0.3, 0.3},   {-kPi / 2 + 0.3, 0.3}};
  for (const auto& [edge, phi] : expected) {
    const Wing wing = one_wing(0.01, 0.01, 0.01, edge).wings.at(0);
    EXPECT_NEAR(wing.phi, phi, 1e-14) << edge;
    EXPECT_GE(wing.phi, 0);
    EXPECT_LE(wing.phi, kPi / 2);
  }
}

TEST(Mesh, ClampFactorActsOnTheClampLineOnly) {
  const double plain = one_wing(0.01, 0.008, 0.009, 0.4).wings.at(0).weight;
  EXPECT_TRUE(one_wing(0.01, 0.008, 0.009, 0.4, true).wings.at(0).on_clamp_line);
  EXPECT_NEAR(one_wing(0.01, 0.008, 0.009, 0.4, true, 2).wings.at(0).weight, 2 * plain, 1e-15);
  EXPECT_NEAR(one_wing(0.01, 0.008, 0.009, 0.4, true, 1.5).wings.at(0).weight, 1.5 * plain, 1e-15);
  Parts parts;  // the edge 0-2 is fixed, but both sides of it are free
  parts.fixed = {1, 0, 1, 0, 0};
  for (const Wing& wing : parts.mesh().wings) EXPECT_FALSE(wing.on_clamp_line);
  parts.fixed = {1, 1, 1, 0, 0};  // now the wing of 0-2 and that of 1-2 lie on the clamp line
  for (const Wing& wing : parts.mesh().wings) EXPECT_TRUE(wing.on_clamp_line);
}

TEST(Mesh, WingsWithoutAFreeVertexAreLeftOut) {
  Parts parts;
  EXPECT_EQ(parts.mesh().wings.size(), 2u);
  parts.fixed = {1, 1, 1, 1, 0};
  ASSERT_EQ(parts.mesh().wings.size(), 1u);
  EXPECT_EQ(parts.mesh().wings[0].vertices, (std::array<int, 4>{1, 2, 0, 4}));
  EXPECT_TRUE(parts.mesh().triangle_is_fixed(0));
  EXPECT_FALSE(parts.mesh().triangle_is_fixed(2));
}

TEST(Mesh, AreasAndShapeDerivatives) {
  const Mesh mesh = Parts{}.mesh();
  for (const RestTriangle& rest : mesh.rest) EXPECT_DOUBLE_EQ(rest.area, 0.5);
  EXPECT_DOUBLE_EQ(mesh.nodal_area.sum(), 1.5);
  EXPECT_DOUBLE_EQ(mesh.nodal_area[2], 0.5);
  EXPECT_DOUBLE_EQ(mesh.nodal_area[4], 1.0 / 6);
  const Mesh one = one_triangle();  // the derivatives of u and v along u and v are 1, 0, 0, 1
  const VecX u = one.rest_uv.col(0), v = one.rest_uv.col(1);
  EXPECT_NEAR(one.rest[0].du.dot(u), 1, 1e-15);
  EXPECT_NEAR(one.rest[0].dv.dot(u), 0, 1e-15);
  EXPECT_NEAR(one.rest[0].du.dot(v), 0, 1e-15);
  EXPECT_NEAR(one.rest[0].dv.dot(v), 1, 1e-15);
  EXPECT_NEAR(one.rest[0].du.sum(), 0, 1e-13);
}

TEST(Mesh, BoundaryRunsCounterClockwiseAndIsTheLongestLoop) {
  const std::vector<int> boundary = Parts{}.mesh().boundary;
  ASSERT_EQ(boundary.size(), 5u);
  std::vector<int> expected{0, 1, 4, 2, 3};
  const auto zero = std::find(boundary.begin(), boundary.end(), 0) - boundary.begin();
  for (size_t i = 0; i < 5; ++i)
    EXPECT_EQ(boundary[(static_cast<size_t>(zero) + i) % 5], expected[i]);
  const Mesh annulus = make_disc_mesh(kCusick, {.vertices = 250});
  for (const int v : annulus.boundary)
    EXPECT_NEAR(annulus.rest_uv.row(v).norm(), kCusick.specimen_radius, 1e-15);
}

TEST(Mesh, FlatState) {
  const VecX x = flat_state(Parts{}.mesh());
  ASSERT_EQ(x.size(), 15);
  EXPECT_EQ(position(x, 4), Vec3(2, 0, 0));
}

TEST(Mesh, RefusesBadInput) {
  EXPECT_EQ(Parts{}.refusal(), "accepted");
  Parts parts;
  parts.triangles.resize(0, 3);
  EXPECT_REFUSAL(parts, "no triangles");
  parts = {};
  parts.fixed.pop_back();
  EXPECT_REFUSAL(parts, "4 clamp flags for 5 vertices");
  parts = {};
  parts.uv(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSAL(parts, "not finite");
  for (const int index : {-1, 5}) {
    parts = {};
    parts.triangles(1, 2) = index;
    EXPECT_REFUSAL(parts, "triangle 1 names vertex " + std::to_string(index));
  }
  parts = {};
  parts.triangles.conservativeResize(2, 3);
  EXPECT_REFUSAL(parts, "vertex 4 belongs to no triangle");
  parts = {};
  parts.uv.row(3) = Vec2(0.5, 0.5);
  EXPECT_REFUSAL(parts, "triangle 1 is degenerate");
  parts = {};
  parts.triangles.row(1) << 0, 3, 2;
  EXPECT_REFUSAL(parts, "triangle 1 is degenerate or clockwise");
  parts = {};
  parts.uv.row(4) = Vec2(0.2, 0.9);  // a third triangle on the edge 0-2
  parts.triangles.row(2) << 0, 2, 4;
  EXPECT_REFUSAL(parts, "edge 0-2 is shared");
  parts = {};  // two triangles that meet in one vertex
  parts.triangles.resize(2, 3);
  parts.triangles << 0, 1, 2, 2, 3, 4;
  parts.uv << 0, 0, 1, 0, 1, 1, 2, 1, 2, 2;
  EXPECT_REFUSAL(parts, "vertex 2 is on the boundary twice");
  for (const double factor : {0.0, -1.0, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(make_mesh(Parts{}.uv, Parts{}.triangles, Parts{}.fixed, factor),
                 std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
