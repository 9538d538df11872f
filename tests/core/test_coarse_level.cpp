#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/coarse_level.h"
#include "core/drape_protocol.h"
#include "core/outline.h"
#include "core/profile.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

using DiscPointer = std::shared_ptr<const Discretization>;

const DiscPointer& disc_1000() {
  static const DiscPointer d = make_disc(kCusick, {.vertices = 1000});
  return d;
}
const DiscPointer& disc_2000() {
  static const DiscPointer d = make_disc(kCusick, {.vertices = 2000});
  return d;
}

Potential potential(const DiscPointer& d, const Fabric& fabric) {
  return Potential(d, fabric, {}, kCusick.gravity);
}

VecX profile_of(const DiscPointer& d, const VecX& x) {
  return radial_profile(trace_outline(d->mesh(), kCusick, x).points).radius;
}

void expect_same_mesh(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.rest_uv, b.rest_uv);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.fixed, b.fixed);
}

TEST(CoarseLevel, StartsAtOneAndAHalfTimesItsSize) {
  EXPECT_EQ(make_disc(kCusick, {.vertices = 3 * kCoarseVertices / 2 - 1})->coarse(), nullptr);
  const DiscPointer d = make_disc(kCusick, {.vertices = 3 * kCoarseVertices / 2});
  ASSERT_NE(d->coarse(), nullptr);
  EXPECT_EQ(d->coarse()->discretization->mesh().vertex_count(), kCoarseVertices);
  EXPECT_EQ(d->coarse()->discretization->coarse(), nullptr);
}

TEST(CoarseLevel, IsTheSameWhateverTheFineMesh) {
  ASSERT_NE(disc_1000()->coarse(), nullptr);
  ASSERT_NE(disc_2000()->coarse(), nullptr);
  expect_same_mesh(disc_1000()->coarse()->discretization->mesh(),
                   disc_2000()->coarse()->discretization->mesh());
}

TEST(CoarseLevel, HasTheSeedRotationAndClampOfTheFineMesh) {
  const DiscMeshOptions fine{.vertices = 900, .seed = 7, .rotation = 0.3, .clamp_wing_factor = 1.5};
  DiscMeshOptions coarse = fine;
  coarse.vertices = kCoarseVertices;
  const DiscPointer d = make_disc(kCusick, fine);
  const Mesh& mesh = d->coarse()->discretization->mesh();
  expect_same_mesh(mesh, make_disc_mesh(kCusick, coarse));
  EXPECT_EQ(mesh.clamp_wing_factor, 1.5);
}

TEST(CoarseLevel, RampsOfTwoResolutionsShareABranch) {
  for (const bool folded : {false, true}) {
    const auto drape = [&](const DiscPointer& d) {
      const Potential E = potential(d, stiff_fabric());
      return folded ? drape_by_lobes(E, kCusick, 6, 0) : drape_by_coarse_ramp(E, 1);
    };
    const Equilibrium a = drape(disc_1000()), b = drape(disc_2000());
    ASSERT_TRUE(a.converged());
    ASSERT_TRUE(b.converged());
    EXPECT_EQ(a.protocol, folded ? "lobes(6, 0)" : "coarse_ramp");
    EXPECT_EQ(a.x.size(), 3 * disc_1000()->mesh().vertex_count());
    EXPECT_EQ(b.x.size(), 3 * disc_2000()->mesh().vertex_count());
    const VecX rho_a = profile_of(disc_1000(), a.x), rho_b = profile_of(disc_2000(), b.x);
    EXPECT_EQ(node_count(rho_a), node_count(rho_b));
    EXPECT_GT(node_count(rho_a), 0);
    // the folds of an isotropic fabric slide around the disc together: measured 2.6 and 4.8 mm
    EXPECT_LE(std::sqrt((rho_a - rho_b).squaredNorm() / kProfileSize), 6e-3);
    // the discretisation error of 1000 vertices: measured 6e-4 and 3e-3, half a point of drape
    // coefficient
    EXPECT_NEAR(rho_a.squaredNorm() / rho_b.squaredNorm(), 1, 6e-3);
  }
}

TEST(CoarseLevel, CountsIncludeBothMeshes) {
  const Potential E = potential(disc_1000(), stiff_fabric());
  const Potential coarse = potential(disc_1000()->coarse()->discretization, stiff_fabric());
  // what the protocol does on the coarse mesh, and then from its state on the fine one
  const Equilibrium chosen = drape_by_coarse_ramp(coarse, 1, {.tolerance = 0.1, .certify = false});
  ASSERT_TRUE(chosen.converged());
  const Equilibrium rest = solve_equilibrium(E, disc_1000()->coarse()->transfer(chosen.x));
  const Equilibrium both = drape_by_coarse_ramp(E, 1);
  EXPECT_EQ(both.x, rest.x);
  EXPECT_GT(chosen.newton_iterations, 0);
  EXPECT_GT(rest.newton_iterations, 0);
  EXPECT_EQ(both.newton_iterations, chosen.newton_iterations + rest.newton_iterations);
  EXPECT_EQ(both.factorizations, chosen.factorizations + rest.factorizations);
}

TEST(CoarseLevel, WithoutOneTheMeshItselfIsUsed) {
  const DiscPointer with = disc(300),
                    without = make_disc(kCusick, {.vertices = 300, .clamp_refinement = 1});
  const Equilibrium a = drape_by_coarse_ramp(potential(with, stiff_fabric()), 2);
  const Equilibrium b = drape_by_coarse_ramp(potential(without, stiff_fabric()), 2);
  ASSERT_TRUE(a.converged());
  EXPECT_EQ(a.negative_eigenvalues, 0);
  EXPECT_NE(a.factor, nullptr);
  EXPECT_LE(a.residual, 1e-8);
  EXPECT_EQ(a.x, b.x);
}

TEST(CoarseLevel, AnIterationLimitOnTheCoarseMeshEndsOnTheFineOne) {
  for (const bool folded : {false, true}) {
    const Potential E = potential(disc_1000(), medium_fabric());
    const EquilibriumOptions few{.max_iterations = 3};
    const Equilibrium drape =
        folded ? drape_by_lobes(E, kCusick, 5, 0, few) : drape_by_coarse_ramp(E, 1, few);
    EXPECT_EQ(drape.status, EquilibriumStatus::iteration_limit);
    EXPECT_EQ(drape.newton_iterations, 3);
    EXPECT_EQ(drape.x.size(), 3 * disc_1000()->mesh().vertex_count());
    EXPECT_TRUE(drape.x.allFinite());
    EXPECT_EQ(drape.factor, nullptr);
    // what is said of the state is true of it, and it can be solved on from there
    EXPECT_EQ(drape.energy, E.energy(drape.x));
    EXPECT_EQ(drape.residual, E.residual(E.gradient(drape.x)));
    EXPECT_TRUE(solve_equilibrium(E, drape.x, {}, drape.preconditioner).converged());
  }
}

TEST(CoarseLevel, TheIterationLimitCountsBothMeshes) {
  const Potential E = potential(disc_1000(), stiff_fabric());
  const int needed = drape_by_coarse_ramp(E, 1).newton_iterations;
  const Equilibrium drape = drape_by_coarse_ramp(E, 1, {.max_iterations = needed - 1});
  EXPECT_EQ(drape.status, EquilibriumStatus::iteration_limit);
  EXPECT_EQ(drape.newton_iterations, needed - 1);
  EXPECT_GT(drape.residual, 1e-8);
}

}  // namespace
}  // namespace drape::test
