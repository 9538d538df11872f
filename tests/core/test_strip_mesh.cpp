#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/strip_mesh.h"

namespace drape {
namespace {

TEST(StripMesh, CoversTheRectangleAndOneRowBehindTheClamp) {
  for (const double angle : {0.0, 0.7}) {
    const StripMeshOptions strip{
        .length = 0.06, .width = 0.02, .edge_length = 0.003, .angle = angle};
    const Mesh mesh = make_strip_mesh(strip);
    double free_area = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t)
      if (!mesh.triangle_is_fixed(t)) free_area += mesh.rest[static_cast<size_t>(t)].area;
    EXPECT_NEAR(free_area, strip.length * strip.width, 1e-12);
    int on_clamp = 0, on_tip = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const Vec2 place = place_in_strip(strip, mesh.rest_uv.row(v));
      EXPECT_LE(std::abs(place.y()), strip.width / 2 + 1e-15);
      EXPECT_LE(place.x(), strip.length + 1e-15);
      EXPECT_EQ(mesh.fixed[static_cast<size_t>(v)] != 0, place.x() < 1e-12);
      on_clamp += std::abs(place.x()) < 1e-12;
      on_tip += place.x() > strip.length - 1e-12;
    }
    EXPECT_EQ(on_clamp, 8);  // seven edges of about 3 mm on 20 mm
    EXPECT_EQ(on_tip, 8);
    int clamp_wings = 0;
    for (const Wing& wing : mesh.wings) clamp_wings += wing.on_clamp_line;
    EXPECT_EQ(clamp_wings, 7);
  }
}

TEST(StripMesh, TrianglesAreAsLargeAsAskedForAndWellShaped) {
  for (const std::uint64_t seed : {1, 2}) {
    const Mesh mesh = make_strip_mesh({.edge_length = 0.004, .seed = seed});
    double smallest = 180, sum = 0;
    int edges = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k) {
        const Vec2 a = mesh.rest_uv.row(mesh.triangles(t, k));
        const Vec2 p = Vec2(mesh.rest_uv.row(mesh.triangles(t, (k + 1) % 3))) - a;
        const Vec2 q = Vec2(mesh.rest_uv.row(mesh.triangles(t, (k + 2) % 3))) - a;
        smallest = std::min(smallest,
                            std::acos(p.dot(q) / (p.norm() * q.norm())) * 180 / std::numbers::pi);
        sum += p.norm();
        ++edges;
      }
    EXPECT_GT(smallest, 25);                   // as of the disc's meshes
    EXPECT_NEAR(sum / edges / 0.004, 1, 0.1);  // real triangles are not equilateral
  }
}

TEST(StripMesh, DeterministicForASeedAndDifferentForAnother) {
  const StripMeshOptions strip{.length = 0.04, .width = 0.02};
  StripMeshOptions other = strip;
  other.seed = 2;
  EXPECT_EQ(make_strip_mesh(strip).rest_uv, make_strip_mesh(strip).rest_uv);
  EXPECT_GT((make_strip_mesh(strip).rest_uv - make_strip_mesh(other).rest_uv).norm(), 1e-3);
}

TEST(StripMesh, RefusesBadInput) {
  EXPECT_THROW(make_strip_mesh({.width = 0}), std::invalid_argument);
  EXPECT_THROW(make_strip_mesh({.edge_length = -1}), std::invalid_argument);
  EXPECT_THROW(make_strip_mesh({.length = 0.2, .width = 0.01, .edge_length = 0.004}),
               std::invalid_argument);
  EXPECT_THROW(make_strip_mesh({.length = INFINITY}), std::invalid_argument);
}

}  // namespace
}  // namespace drape
