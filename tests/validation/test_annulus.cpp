// The specimen as a stiff plate: clamped at the support, sagging a little under its weight.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene.h"
#include "experiments/validation_cases.h"

namespace drape {
namespace {

/// Mean relative error of the rim's sag over three meshes.
double mean_error(int vertices, double clamp_refinement) {
  double sum = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Comparison c =
        annulus_sag({.vertices = vertices, .seed = seed, .clamp_refinement = clamp_refinement});
    EXPECT_EQ(c.status, "converged");
    sum += c.error() / 3;
  }
  return sum;
}

TEST(Annulus, SagsLikeAPlateWithNuMinusOneThird) {
  EXPECT_NEAR(mean_error(2000, 1), 0, 0.06);  // 0.047 measured, see the next test
  EXPECT_NEAR(mean_error(2000, 2), 0, 0.05);  // 0.036 measured
  // the reference with the Poisson's ratio of steel is further away
  const Scene scene;
  const double steel =
      reference::annulus_sag(1, 1, scene.support_radius, scene.specimen_radius, 0.3);
  const double hinges =
      reference::annulus_sag(1, 1, scene.support_radius, scene.specimen_radius, -1.0 / 3);
  EXPECT_GT(std::abs(steel / hinges - 1), 0.06);
}

TEST(Annulus, ClampNeedsWingsOfTwiceTheWeight) {
  // What error is left with weight 2 is that of the mesh's radial rigidity, lower than its bulk's
  // by 11 % at 500 and 5 % at 1000 vertices. Without it the sag is right within 2.3 % and 0.7 %
  // (measured), and with weight 1 wrong by more than 20 %, as if half a row of triangles were soft.
  for (const int vertices : {500, 1000}) {
    const Comparison twice = annulus_sag({.vertices = vertices, .clamp_refinement = 1}),
                     single = annulus_sag(
                         {.vertices = vertices, .clamp_wing_factor = 1, .clamp_refinement = 1});
    EXPECT_NEAR(twice.measured / twice.expected * twice.radial_energy_ratio, 1, 0.03);
    EXPECT_GT(single.measured / single.expected * twice.radial_energy_ratio, 1.15);
  }
}

TEST(Annulus, ErrorFallsWithTheMesh) {
  // measured 0.099 and 0.034, 0.097 and 0.016; order 1 would divide by 2.8
  for (const double refinement : {1, 2})
    EXPECT_LT(std::abs(annulus_sag({.vertices = 4000, .clamp_refinement = refinement}).error()),
              std::abs(mean_error(500, refinement)) / 2);
}

}  // namespace
}  // namespace drape
