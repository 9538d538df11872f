#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/coarse_level.h"
#include "core/drape_protocol.h"
#include "core/guided.h"
#include "core/outline.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

TEST(Guided, FindsADrapeFromItsOutline) {
  const Potential potential(disc(300), stiff_fabric(), {}, kCusick.gravity);
  const auto profile = [&](const VecX& x) {
    return radial_profile(trace_outline(potential.mesh(), kCusick, x).points).radius;
  };
  const Equilibrium target = drape_by_lobes(potential, kCusick, 4, 0.1);
  ASSERT_TRUE(target.converged());
  const Guide guide{.radius = harmonics(profile(target.x), 24)};
  const Equilibrium held = solve_under_guide(potential, kCusick, guide, {.tolerance = 0.1});
  const Equilibrium drape = drape_guided(potential, kCusick, guide, {1, 0.1, 0.01});
  ASSERT_TRUE(held.converged() && drape.converged());
  EXPECT_EQ(drape.protocol, "guided");
  EXPECT_GT(drape.newton_iterations, held.newton_iterations);
  // released: an equilibrium of the unguided potential, and the one the outline was taken from
  EXPECT_LE(potential.residual(potential.gradient(drape.x)), 1e-8);
  const double rms = std::sqrt((profile(drape.x) - profile(target.x)).squaredNorm() / kProfileSize);
  EXPECT_LE(rms, 1e-5);  // tolerances of two solves; a neighbouring branch is .4 mm away
}

TEST(Guided, ChosenOnTheCoarseMeshTheDrapeStillFollowsItsOutline) {
  const Potential potential(make_disc(kCusick, {.vertices = 900}), stiff_fabric(), {},
                            kCusick.gravity);
  const Equilibrium drape = drape_by_lobes(potential, kCusick, 5, 0.3);
  const VecX observed =
      radial_profile(trace_outline(potential.mesh(), kCusick, drape.x).points).radius;
  const Guide guide{.radius = harmonics(observed, 24)};
  const Equilibrium found = solve_under_guide_from_coarse(potential, kCusick, guide);
  ASSERT_TRUE(found.converged());
  EXPECT_EQ(found.protocol, "guided");
  EXPECT_EQ(found.x.size(), 3 * potential.mesh().vertex_count());
  const VecX profile =
      radial_profile(trace_outline(potential.mesh(), kCusick, found.x).points).radius;
  EXPECT_LE((profile - observed).cwiseAbs().maxCoeff(), 1e-3);  // kappa = 1 pulls with the weight
  // on a mesh without a coarse level there is only one way
  const Potential coarse(disc(400), stiff_fabric(), {}, kCusick.gravity);
  EXPECT_EQ(solve_under_guide_from_coarse(coarse, kCusick, guide).x,
            solve_under_guide(coarse, kCusick, guide).x);
}

TEST(Guided, NeedsAStrength) {
  const Potential potential(disc(250), stiff_fabric(), {}, kCusick.gravity);
  const Guide guide{.radius = harmonics(VecX::Constant(kProfileSize, 0.12), 4)};
  EXPECT_THROW(drape_guided(potential, kCusick, guide, {}), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
