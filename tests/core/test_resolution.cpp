#include "core/resolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/drape_protocol.h"
#include "core/profile.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

/// An outline of `lobes` lobes, turned by `phase`.
VecX lobed(int lobes, double phase = 0, double height = 0.006) {
  VecX radius(kProfileSize);
  for (int i = 0; i < kProfileSize; ++i)
    radius[i] = 0.12 + height * std::cos(lobes * (2 * M_PI * i / kProfileSize - phase));
  return radius;
}

struct Coefficients {
  double mesh, other_mesh;
  int lobes = 5, other_lobes = 5;
};

/// Climbs over made-up drapes on meshes of 1000, 2000, 4000, ... vertices.
Resolution climb_over(const std::vector<Coefficients>& rungs, double tolerance) {
  return climb(static_cast<int>(rungs.size()), tolerance, [&](int rung, bool other) -> DrapeSeen {
    const Coefficients& of = rungs[static_cast<size_t>(rung)];
    return {.converged = true,
            .vertices = 1000 << rung,
            .drape_coefficient = other ? of.other_mesh : of.mesh,
            .profile = lobed(other ? of.other_lobes : of.lobes)};
  });
}

TEST(SameBranch, TurnedOutlinesMatch) {
  const auto seen = [](const VecX& profile) { return DrapeSeen{true, 1000, 0.5, profile}; };
  const DrapeSeen five = seen(lobed(5));
  EXPECT_TRUE(same_branch(five, seen(lobed(5, 0.5))));
  EXPECT_FALSE(same_branch(five, seen(lobed(6))));
  // waves that differ by h in height are h / sqrt(2) apart: on both sides of 2 mm
  EXPECT_TRUE(same_branch(five, seen(lobed(5, 0, 0.006 + 2.7e-3))));
  EXPECT_FALSE(same_branch(five, seen(lobed(5, 0, 0.006 + 2.9e-3))));
}

TEST(Climb, ErrorsOfFirstOrderInTheCountAreBounded) {
  // coefficient 0.5 + 0.02 (1000 / n): errors 0.02, 0.01, 0.005, ...
  std::vector<Coefficients> rungs;
  for (int i = 0; i < 6; ++i) {
    const double c = 0.5 + 0.02 / (1 << i);
    rungs.push_back({c, c});
  }
  const Resolution found = climb_over(rungs, 0.004);
  EXPECT_EQ(found.status, ResolutionStatus::within_tolerance);
  const Rung& chosen = found.rungs[static_cast<size_t>(found.chosen)];
  const double error = std::abs(chosen.drape_coefficient - 0.5);
  EXPECT_LE(error, chosen.error());
  EXPECT_LE(chosen.error(), 0.004);
  EXPECT_LE(chosen.error(), 2.5 * error);  // not wasteful: twice the error, for safety
  for (const Rung& rung : found.rungs)
    EXPECT_GE(rung.estimate, std::abs(rung.drape_coefficient - 0.5));
}

TEST(Climb, StopsOnTheCoarserRungWhereThatIsEnough) {
  const Resolution found = climb_over({{0.5, 0.501}, {0.5005, 0.5}, {0.5, 0.5}}, 0.005);
  EXPECT_EQ(found.status, ResolutionStatus::within_tolerance);
  EXPECT_EQ(found.chosen, 0);
  EXPECT_EQ(found.rungs.size(), 2);  // the third is not draped
}

TEST(Climb, ScatterCountsAsError) {
  // refinement changes nothing, but the first two meshes are 1 point from others of their size
  const Resolution found = climb_over({{0.5, 0.51}, {0.5, 0.51}, {0.5, 0.503}, {0.5, 0.5}}, 0.005);
  EXPECT_EQ(found.status, ResolutionStatus::within_tolerance);
  EXPECT_EQ(found.chosen, 2);
  EXPECT_NEAR(found.rungs[2].error(), 0.003, 1e-12);
}

TEST(Climb, StopsWhereTheMeshDecides) {
  const Resolution found =
      climb_over({{0.5, 0.51}, {0.51, 0.5}, {0.5, 0.51}, {0.5, 0.5}, {0.5, 0.5}}, 0.005);
  EXPECT_EQ(found.status, ResolutionStatus::limited_by_mesh_scatter);
  EXPECT_EQ(found.chosen, 2);
  EXPECT_GE(found.rungs[2].error(), 0.01);
}

TEST(Climb, GoesOnWhileScatterShrinks) {
  // to less than half in two rungs
  const Resolution found =
      climb_over({{0.5, 0.54}, {0.5, 0.52}, {0.5, 0.51}, {0.5, 0.506}, {0.5, 0.503}}, 0.005);
  EXPECT_EQ(found.status, ResolutionStatus::within_tolerance);
  EXPECT_EQ(found.chosen, 4);
}

TEST(Climb, OtherBranchesOnOtherMeshesAreScatter) {
  const Coefficients lost{0.5, 0.502, 5, 6};
  const Resolution found = climb_over({{0.4, 0.402, 4, 5}, lost, lost, lost}, 1e-3);
  EXPECT_EQ(found.status, ResolutionStatus::limited_by_mesh_scatter);
  EXPECT_EQ(found.rungs.size(), 3);
  EXPECT_FALSE(found.rungs[1].same_branch);  // four lobes became five
  EXPECT_TRUE(found.rungs[2].same_branch);
  EXPECT_FALSE(found.rungs[2].other_mesh_same_branch);
}

TEST(Climb, AnotherBranchIsNoEvidence) {
  // equal coefficients, but of drapes with other folds
  const Resolution found = climb_over({{0.5, 0.5, 4, 4}, {0.5, 0.5, 5, 5}, {0.5, 0.5}}, 0.005);
  EXPECT_EQ(found.status, ResolutionStatus::within_tolerance);
  EXPECT_EQ(found.chosen, 1);
  EXPECT_EQ(found.rungs.size(), 3);
}

TEST(Climb, EndsWithTheLadder) {
  const Resolution found = climb_over({{0.5, 0.5}, {0.52, 0.52}}, 0.005);
  EXPECT_EQ(found.status, ResolutionStatus::limited_by_size);
  EXPECT_EQ(found.chosen, 1);
}

TEST(Climb, AFailedSolveLeavesTheRungBefore) {
  const Resolution found = climb(3, 0.005, [](int rung, bool) -> DrapeSeen {
    return {rung < 1, 1000, 0.5, lobed(5)};
  });
  EXPECT_EQ(found.status, ResolutionStatus::limited_by_solver);
  EXPECT_EQ(found.chosen, 0);
  EXPECT_EQ(found.rungs.size(), 1);
}

ResolvedDrape resolved(double tolerance, std::vector<int> vertices) {
  return drape_resolved(
      kCusick, {},
      [](const DiscMeshOptions& size) {
        return Potential(std::make_shared<const Discretization>(make_disc_mesh(kCusick, size)),
                         stiff_fabric(), {}, kCusick.gravity);
      },
      ContactMode::automatic, [](const Potential& of) { return drape_by_coarse_ramp(of, 1); },
      {.tolerance = tolerance, .vertices = std::move(vertices)});
}

TEST(DrapeResolved, ReturnsTheCoarseDrapeWhereThatIsEnough) {
  const ResolvedDrape coarse = resolved(0.05, {600, 800, 1000});
  EXPECT_EQ(coarse.resolution.status, ResolutionStatus::within_tolerance);
  EXPECT_EQ(coarse.resolution.rungs.size(), 2);
  EXPECT_EQ(coarse.potential.mesh().vertex_count(), 600);
  const VecX& x = coarse.drape.equilibrium.x;
  EXPECT_LE(coarse.potential.residual(coarse.potential.gradient(x)), 1e-8);
}

TEST(DrapeResolved, FollowsTheBranchToTheEndOfTheLadder) {
  const ResolvedDrape fine = resolved(1e-6, {600, 800});
  EXPECT_EQ(fine.resolution.status, ResolutionStatus::limited_by_size);
  EXPECT_EQ(fine.potential.mesh().vertex_count(), 800);
  ASSERT_EQ(fine.resolution.rungs.size(), 2);
  const Rung &first = fine.resolution.rungs[0], &last = fine.resolution.rungs[1];
  EXPECT_TRUE(last.same_branch);
  EXPECT_EQ(last.node_count, first.node_count);
  const Equilibrium& equilibrium = fine.drape.equilibrium;
  EXPECT_TRUE(equilibrium.converged());
  EXPECT_EQ(equilibrium.protocol, "coarse_ramp");
  EXPECT_LE(fine.potential.residual(fine.potential.gradient(equilibrium.x)), 1e-8);
  // the estimate covers what refinement changes, and the other mesh is not the same one
  EXPECT_GE(first.estimate, std::abs(last.drape_coefficient - first.drape_coefficient));
  EXPECT_GT(last.scatter, 0);
}

TEST(DrapeResolved, RefusesNoToleranceAndNoSizes) {
  EXPECT_THROW(resolved(0, {300}), std::invalid_argument);
  EXPECT_THROW(resolved(0.005, {}), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
