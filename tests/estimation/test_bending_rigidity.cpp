#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "estimation/bending_rigidity.h"

namespace drape {
namespace {

Fabric with_bending(const Vec3& k_b) {
  Fabric fabric;
  fabric.k_bu = k_b[0];
  fabric.k_bv = k_b[1];
  fabric.k_bh = k_b[2];
  return fabric;
}

/// B / 4 of equilateral wings, by quadrature over the direction of the wing.
double averaged_stiffness(const Vec3& k_b, double bend) {
  constexpr int kSamples = 20000;
  double sum = 0, weights = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double direction = std::numbers::pi * (i + 0.5) / kSamples;
    const double phi = std::min(direction, std::numbers::pi - direction);
    const double s = 4 * phi / std::numbers::pi;  // Eq. 4
    const double k = s < 1 ? (1 - s) * k_b[0] + s * k_b[2] : (s - 1) * k_b[1] + (2 - s) * k_b[2];
    const double c2 = std::pow(std::cos(direction - bend), 2);
    const double weight = std::pow(c2 - (1 - c2) / 3, 2);
    sum += weight * k;
    weights += weight;
  }
  return sum / weights;
}

TEST(EffectiveRigidity, IsFourTimesAnIsotropicStiffness) {
  const Vec3 B = effective_rigidity(with_bending(Vec3::Constant(2e-6)));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(B[i], 8e-6, 8e-6 * 2e-6);  // six digits in the matrix
}

TEST(EffectiveRigidity, IsTheAverageOverWingsOfAllDirections) {
  const Vec3 k_b(1e-6, 5e-6, 2e-6);
  const Vec3 B = effective_rigidity(with_bending(k_b));
  const double bends[3] = {0, std::numbers::pi / 2, std::numbers::pi / 4};
  for (int i = 0; i < 3; ++i)  // six digits in the matrix, kinks of the hats in the quadrature
    EXPECT_NEAR(B[i] / (4 * averaged_stiffness(k_b, bends[i])), 1, 1e-5);
}

TEST(HingeStiffness, InvertsWhatCanBeReached) {
  const Vec3 k_b(1e-6, 4e-6, 2e-6);
  const HingeStiffness found = hinge_stiffness(effective_rigidity(with_bending(k_b)));
  EXPECT_LT((found.k_b - k_b).norm(), 1e-13 * k_b.norm());  // rounding times condition, about 6
  EXPECT_LT(found.misfit, 1e-13);
}

TEST(HingeStiffness, IsNeverNegativeAndMeetsTheOptimalityConditions) {
  std::mt19937_64 random(7);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  int bounded = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 B =
        1e-5 * Vec3(std::pow(10, uniform()), std::pow(10, uniform()), std::pow(10, uniform()));
    const HingeStiffness found = hinge_stiffness(B);
    const Vec3 miss = effective_rigidity(with_bending(found.k_b)) - B;
    EXPECT_NEAR(found.misfit, miss.norm() / B.norm(), 1e-12);  // rounding
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(found.k_b[i], 0);
      const Vec3 column = effective_rigidity(with_bending(Vec3::Unit(i)));
      const double gradient = column.dot(miss) / (column.norm() * B.norm());
      // Karush-Kuhn-Tucker, to the rounding of a 3 x 3 least-squares solution.
      if (found.k_b[i] > 0)
        EXPECT_NEAR(gradient, 0, 1e-13);
      else
        EXPECT_GE(gradient, -1e-13);
    }
    if (found.k_b.minCoeff() == 0) {
      EXPECT_GT(found.misfit, 0);
      ++bounded;
    }
  }
  EXPECT_GT(bounded, 20);  // both kinds of solution were seen
  EXPECT_LT(bounded, 180);
}

TEST(HingeStiffness, RefusesWhatIsNoRigidity) {
  EXPECT_THROW(hinge_stiffness({0, 1e-6, 1e-6}), std::invalid_argument);
  EXPECT_THROW(hinge_stiffness({1e-6, -1e-6, 1e-6}), std::invalid_argument);
  EXPECT_THROW(hinge_stiffness({1e-6, 1e-6, std::numeric_limits<double>::quiet_NaN()}),
               std::invalid_argument);
}

}  // namespace
}  // namespace drape
