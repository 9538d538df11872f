#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>

#include "core/drape_protocol.h"
#include "estimation/popping.h"
#include "estimation/staged_fit.h"
#include "tests/support/derivative_check.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

TEST(Popping, AVertexIsMirroredInThePlaneOfItsNeighbours) {
  const Mesh mesh = disc(500)->mesh();
  VecX x = flat_state(mesh);
  EXPECT_TRUE(poppable(mesh, x, 0.01).empty());
  int raised = 0;
  while (mesh.fixed[static_cast<size_t>(raised)] != 0 ||
         std::ranges::find(mesh.boundary, raised) != mesh.boundary.end())
    ++raised;
  constexpr double kHeight = 1e-3;
  x[3 * raised + 2] = kHeight;
  const std::vector<Pop> pops = poppable(mesh, x, 0.06);
  ASSERT_EQ(pops.size(), 1u);  // its neighbours' planes tilt, and pass below them by less
  EXPECT_EQ(pops[0].vertex, raised);
  EXPECT_NEAR(pops[0].to[2], -kHeight, 1e-12);
  EXPECT_NEAR(pops[0].to[0], x[3 * raised], 1e-12);
  EXPECT_TRUE(poppable(mesh, x, 0.5).empty());
}

TEST(Popping, WhatAStepOfTheUnknownsTakesAwayIsNoMiss) {
  Random random(1);
  const MatX jacobian = random_vector(60, random).reshaped(30, 2);
  const VecX step = Eigen::Vector2d(0.3, -0.2);
  const VecX reachable = 10 * jacobian * step;
  VecX other = random_vector(30, random);
  other -= jacobian * jacobian.colPivHouseholderQr().solve(other);
  const ReachableResidual far(jacobian, 1e-3, 1e3), near(jacobian, 1e3, 1e-3);
  EXPECT_NEAR(far.norm(reachable + other) / other.norm(), 1, 1e-9);
  EXPECT_NEAR(near.norm(reachable) / reachable.norm(), 1, 1e-9);  // such a step is out of reach
}

/// A membrane that is stiff enough on the mesh to hold vertices popped.
Fabric inextensible_fabric() {
  Fabric fabric = stiff_fabric();
  fabric.k_u = 4e4;
  fabric.k_v = 3e4;
  fabric.k_h = 200;
  return fabric;
}

/// A drape and its neighbour with one vertex popped.
TEST(Popping, TheVertexThatTheOutlineTellsOfIsFound) {
  const Potential free(disc(500), inextensible_fabric(), {}, kCusick.gravity);
  const Equilibrium drape = drape_by_lobes(free, kCusick, 5, 0);
  ASSERT_TRUE(drape.converged());
  Equilibrium neighbour;
  for (const Pop& pop : poppable(free.mesh(), drape.x, 0.05)) {
    VecX x = drape.x;
    x.segment<3>(3 * pop.vertex) = pop.to;
    neighbour = solve_equilibrium(free, x);
    if (neighbour.converged() && largest_distance(neighbour.x, drape.x) > 1e-3) break;
  }
  ASSERT_GT(largest_distance(neighbour.x, drape.x), 1e-3);

  OutlineObservation seen;
  seen.profile = radial_profile(trace_outline(free.mesh(), kCusick, neighbour.x).points).radius;
  seen.noise = 1e-5;
  StagedFit fit({{free, kCusick, seen, drape}}, free.fabric(), {});
  fit.take_start_states();
  ASSERT_TRUE(fit.set_guides(0));
  const double miss = fit.largest_miss();
  EXPECT_GT(miss, 2);
  ASSERT_TRUE(pop_through(fit, 1000));
  EXPECT_LT(fit.largest_miss(), 0.5);
  EXPECT_LT(largest_distance(fit.state().pictures[0].equilibrium.x, neighbour.x), 1e-4);
  EXPECT_LE(fit.pops(), 1000);
}

TEST(Popping, WithoutPopsTheFitStaysAsItIs) {
  const Potential free(disc(500), stiff_fabric(), {}, kCusick.gravity);
  const Equilibrium drape = drape_by_lobes(free, kCusick, 5, 0);
  OutlineObservation seen;
  seen.profile = radial_profile(trace_outline(free.mesh(), kCusick, drape.x).points).radius;
  seen.profile.array() += 1e-3;
  seen.noise = 1e-5;
  StagedFit fit({{free, kCusick, seen, drape}}, free.fabric(), {});
  fit.take_start_states();
  ASSERT_TRUE(fit.set_guides(0));
  const FitState first = fit.state();
  EXPECT_FALSE(pop_through(fit, 0));
  EXPECT_TRUE(fit.is_at(first));
  EXPECT_EQ(fit.pops(), 0);
}

}  // namespace
}  // namespace drape::test
