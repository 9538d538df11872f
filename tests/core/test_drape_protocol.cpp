#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/drape_protocol.h"
#include "core/outline.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

const std::shared_ptr<const Discretization>& small_disc() {
  static const std::shared_ptr<const Discretization> d = disc(300);
  return d;
}

Potential potential(const Fabric& fabric) {
  return Potential(small_disc(), fabric, {}, kCusick.gravity);
}

void expect_clamped(const VecX& x) {
  const Mesh& mesh = small_disc()->mesh();
  const VecX flat = flat_state(mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.fixed[static_cast<size_t>(v)]) {
      EXPECT_EQ(position(x, v), position(flat, v));
    }
}

TEST(DrapeProtocol, RampIsNamedConvergedAndDeterministic) {
  Potential E = potential(stiff_fabric());
  const Equilibrium a = drape_by_ramp(E, 3);
  ASSERT_TRUE(a.converged());
  EXPECT_EQ(a.protocol, "ramp");
  EXPECT_EQ(a.x, drape_by_ramp(E, 3).x);
  EXPECT_LE(E.residual(E.gradient(a.x)), 1e-8);  // at the whole of gravity
  EXPECT_GT(a.newton_iterations, 16);            // of all steps together
  E.set_guide(Guide{harmonics(VecX::Constant(kProfileSize, 0.1), 2), Vec2::Zero(), 1});
  EXPECT_EQ(a.x, drape_by_ramp(E, 3).x);  // guides are ignored
}

TEST(DrapeProtocol, RampStopsAtTheIterationLimitOfAllStepsTogether) {
  const Potential E = potential(medium_fabric());
  const Equilibrium a = drape_by_ramp(E, 1, {.max_iterations = 5});
  EXPECT_EQ(a.status, EquilibriumStatus::iteration_limit);
  EXPECT_EQ(a.newton_iterations, 5);
  // at the whole of gravity, although the ramp ended below it
  EXPECT_EQ(a.energy, E.energy(a.x));
  EXPECT_EQ(a.residual, E.residual(E.gradient(a.x)));
}

TEST(DrapeProtocol, FoldedStateHasItsLobes) {
  const Mesh& mesh = small_disc()->mesh();
  for (const int lobes : {3, 6}) {
    const VecX x = folded_state(mesh, kCusick, lobes, 0.2);
    expect_clamped(x);
    const Outline outline = trace_outline(mesh, kCusick, x);
    EXPECT_EQ(node_count(radial_profile(outline.points).radius), lobes);
    for (const int v : mesh.boundary) {
      EXPECT_LT(x[3 * v + 2], 0);
      // turned by the phase: a rim vertex on the crest reaches further than one between crests
      const double angle = std::atan2(mesh.rest_uv(v, 1), mesh.rest_uv(v, 0));
      const double crest = std::cos(lobes * (angle - 0.2));
      const double radius = x.segment<2>(3 * v).norm();
      if (crest > 0.9) {
        EXPECT_GT(radius, 0.143);
      } else if (crest < -0.9) {
        EXPECT_LT(radius, 0.135);
      }
    }
  }
}

TEST(DrapeProtocol, LobesAreNamedWithTheirPhase) {
  const Equilibrium a = drape_by_lobes(potential(stiff_fabric()), kCusick, 4, 0.25);
  EXPECT_TRUE(a.converged());
  EXPECT_EQ(a.protocol, "lobes(4, 0.25)");
}

TEST(DrapeProtocol, StateFromOutlineEndsAtTheOutline) {
  const Mesh& mesh = small_disc()->mesh();
  VecX radius(kProfileSize);
  for (int i = 0; i < kProfileSize; ++i)
    radius[i] = 0.12 + 0.006 * std::cos(4 * 2 * M_PI * i / kProfileSize + 0.5);
  const Guide guide{harmonics(radius, 8), Vec2::Zero(), 1};
  const VecX x = state_from_outline(mesh, kCusick, guide);
  expect_clamped(x);
  for (const int v : mesh.boundary) {
    // rim vertices have their rest length of meridian: they end on the outline to rounding
    EXPECT_NEAR(guide_miss(guide, x.segment<2>(3 * v)).value, 0, 1e-12);
    EXPECT_LT(x[3 * v + 2], 0);
  }
  // arcs keep the length of the overhang: no vertex is further from the clamp than at rest
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.fixed[static_cast<size_t>(v)]) continue;
    const Vec2 uv = mesh.rest_uv.row(v);
    const Vec2 clamp = kCusick.support_radius * uv.normalized();
    EXPECT_LE((position(x, v) - Vec3(clamp.x(), clamp.y(), 0)).norm(),
              uv.norm() - kCusick.support_radius + 1e-12);
  }
}

}  // namespace
}  // namespace drape::test
