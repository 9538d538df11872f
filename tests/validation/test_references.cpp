// The references themselves, against limits known by hand.
#include "experiments/references.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace drape::reference {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(References, ElasticaOfSmallLoadIsABeam) {
  const double q = 1e-3;  // q L^4 / (8 B), corrections of relative order (q L^3/B)^2
  EXPECT_NEAR(heavy_elastica({.B = 1}, q, 1).drop / (q / 8), 1, 1e-6);
  EXPECT_NEAR(heavy_elastica({.B = 1}, q, 1).reach, 1, 1e-6);
}

TEST(References, ElasticaAgreesWithFiniteDifferences) {
  // drop over length by elastica_drop() of experiments/figures/validation.py, another method, whose
  // error at 2000 intervals is about 1e-6
  EXPECT_NEAR(heavy_elastica({.B = 1}, std::pow(0.5, 3), 1).drop, 0.0156219, 1e-6);
  EXPECT_NEAR(heavy_elastica({.B = 1}, 1, 1).drop, 0.1234714, 1e-6);
  EXPECT_NEAR(heavy_elastica({.B = 1}, 8, 1).drop, 0.6406306, 1e-6);
  EXPECT_NEAR(heavy_elastica({.B = 1}, 64, 1).drop, 0.9201126, 1e-6);
}

TEST(References, ElasticaOfLargeLoadHangsStraightDown) {
  // near the clamp an elastica under the pull q L of all its weight: B theta'' = -q L cos theta,
  // whose reach is (2 B / (q L))^(1/2), as B/2 kappa^2 = q L (1 - sin theta) integrates to
  // sqrt(B / (q L)) times the integral of cos theta / sqrt(2 (1 - sin theta)) = sqrt 2
  const Tip tip = heavy_elastica({.B = 1}, 1e3, 1);
  EXPECT_NEAR(tip.reach / std::sqrt(2e-3), 1, 0.05);  // the pull falls towards the tip
  EXPECT_NEAR(tip.drop, 1, 0.05);
}

TEST(References, StripIsABeamWhenLittleBentAndAPlateWhenMuchBent) {
  const StripSection section{.B = 1e-5, .width = 0.02, .modulus = 1e3};
  // layer (4 B/(E kappa^2))^(1/4) of the width's half: 45 and .045
  EXPECT_NEAR(moment(section, 1e-3) / (section.B * 1e-3), 8.0 / 9, 1e-4);
  EXPECT_NEAR(moment(section, 1e3) / (section.B * 1e3), 1, 0.01);
  double last = 0;
  for (double kappa = 0.1; kappa < 1e3; kappa *= 1.5) {
    EXPECT_GT(moment(section, kappa), last);
    last = moment(section, kappa);
  }
}

TEST(References, FiniteStretchBeginsWithTheSmallStrainModulus) {
  const Stretch k{300, 500, 40};
  for (const double angle : {0.0, kPi / 6, kPi / 4, kPi / 2})
    EXPECT_NEAR((uniaxial_stretch(k, angle, 1e-4) - 1) / (1e-4 / uniaxial_modulus(k, angle)), 1,
                1e-4);  // second order in the strain of 1e-6, over its rounding of 1e-10
  // along u: C_uu - C_uv^2 / C_vv
  EXPECT_NEAR(uniaxial_modulus(k, 0), 320 - 20 * 20 / 520.0, 1e-9);
}

TEST(References, StretchAlongTheBiasIsThatOfTheTurnedPairs) {
  // at 45 degrees k_h is the pair along and across, and (k_u + k_v)/2 each the pair at 45 degrees
  const Stretch k{300, 300, 40}, turned{40, 40, 300};
  for (const double N : {0.1, 5.0, 50.0})
    EXPECT_NEAR(uniaxial_stretch(k, kPi / 4, N), uniaxial_stretch(turned, 0, N), 1e-10);
}

TEST(References, PlateOfANarrowAnnulusIsACantilever) {
  const double width = 1e-3, B = 2, q = 3;  // curved with radius 1: relative error of its width
  EXPECT_NEAR(annulus_sag(B, q, 1, 1 + width, 0.3) / (q * std::pow(width, 4) / (8 * B)), 1, 0.01);
}

}  // namespace
}  // namespace drape::reference
