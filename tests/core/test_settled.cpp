#include <gtest/gtest.h>

#include "core/drape_protocol.h"
#include "core/settled.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

/// A membrane stiff enough for the mesh to hold vertices popped.
Fabric stiff_membrane() {
  Fabric fabric;
  fabric.areal_density = 0.2;
  fabric.k_u = fabric.k_v = 2000;
  fabric.k_h = 200;
  fabric.k_bu = fabric.k_bv = fabric.k_bh = 1e-5;
  return fabric;
}

TEST(Settled, PoppedDrapesSettleWithLessEnergyAndAreThenTheirOwn) {
  const Potential potential(disc(400), stiff_membrane(), {}, kCusick.gravity);
  int moved = 0;
  for (const int lobes : {5, 6, 7}) {
    const Equilibrium drape = drape_by_lobes(potential, kCusick, lobes, 0.1);
    ASSERT_TRUE(drape.converged());
    const Equilibrium settled = settle(potential, kCusick, drape);
    EXPECT_EQ(settled.protocol, drape.protocol + ", settled");
    EXPECT_LE(potential.residual(potential.gradient(settled.x)), 1e-8);
    EXPECT_EQ(settled.negative_eigenvalues, 0);
    EXPECT_GT(settled.factorizations, drape.factorizations);
    if (largest_distance(settled.x, drape.x) > 1e-3) {
      ++moved;
      EXPECT_LT(settled.energy, drape.energy);
    }
    const Equilibrium again = settle(potential, kCusick, settled, {}, {.rounds = 1});
    EXPECT_EQ(again.protocol, settled.protocol + ", settled");
    EXPECT_LE(largest_distance(again.x, settled.x), 1e-5);
  }
  EXPECT_GE(moved, 1);
}

TEST(Settled, WhereRoundsDoNotSufficeTheDrapeIsSaidToBeUnsettled) {
  const Potential potential(disc(400), stiff_membrane(), {}, kCusick.gravity);
  const Equilibrium popped = drape_by_lobes(potential, kCusick, 6, 0.1);
  const Equilibrium none = settle(potential, kCusick, popped, {}, {.rounds = 0});
  EXPECT_EQ(none.protocol, popped.protocol + ", unsettled");
  EXPECT_EQ(none.x, popped.x);
  EXPECT_EQ(none.newton_iterations, popped.newton_iterations);
}

TEST(Settled, AFailedDrapeStaysAsItIs) {
  const Potential potential(disc(400), stiff_membrane(), {}, kCusick.gravity);
  const Equilibrium failed = drape_by_lobes(potential, kCusick, 6, 0.1, {.max_iterations = 3});
  ASSERT_FALSE(failed.converged());
  const Equilibrium same = settle(potential, kCusick, failed);
  EXPECT_EQ(same.status, failed.status);
  EXPECT_EQ(same.protocol, failed.protocol);
  EXPECT_EQ(same.x, failed.x);
}

}  // namespace
}  // namespace drape::test
