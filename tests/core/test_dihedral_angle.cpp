#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/dihedral_angle.h"
#include "tests/support/derivative_check.h"

namespace drape::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// A wing of uneven triangles folded by delta about its edge, which lies along x.
Corners4<double> folded(double delta) {
  const double half = delta / 2;
  Corners4<double> x;
  x.col(0) = Vec3(0, 0, 0);
  x.col(1) = Vec3(0.012, 0, 0);
  x.col(2) = Vec3(0.004, 0.009 * std::cos(half), 0.009 * std::sin(half));
  x.col(3) = Vec3(0.010, -0.013 * std::cos(half), 0.013 * std::sin(half));
  return x;
}

/// The same, turned and shifted.
Corners4<double> placed(const Corners4<double>& x) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(0.3, 1, -0.6).normalized()).toRotationMatrix();
  return (turn * x).colwise() + Vec3(0.05, -0.1, 0.02);
}

double angle(const VecX& x) { return fold_angle(Corners4<double>(x.reshaped(3, 4))); }

constexpr double kAngles[] = {
    -3.0, -kPi / 2 - 1e-3, -kPi / 2, -0.7,           -1e-4, -1e-9, 0, 1e-9, 1e-4,
    0.3,  kPi / 2 - 1e-6,  kPi / 2,  kPi / 2 + 1e-3, 2.5,   3.1};

TEST(DihedralAngle, ValueAndSign) {
  for (const double delta : kAngles) {
    EXPECT_NEAR(fold_angle(folded(delta)), delta, 1e-15);  // a valley seen from +z is positive
    // positions of 0.1 m hold heights of 0.01 m to 1e-15
    EXPECT_NEAR(fold_angle(placed(folded(delta))), delta, 3e-14);
  }
}

TEST(DihedralAngle, ExchangingTheSidesKeepsTheAngle) {
  Corners4<double> x = folded(0.8), exchanged;
  exchanged << x.col(1), x.col(0), x.col(3), x.col(2);
  EXPECT_NEAR(fold_angle(exchanged), 0.8, 1e-14);
}

TEST(DihedralAngle, GradientAgainstAutomaticDerivatives) {
  using Jet = ceres::Jet<double, 12>;
  for (const double delta : kAngles) {
    const Corners4<double> x = placed(folded(delta));
    Corners4<Jet> jets;
    for (int i = 0; i < 12; ++i) jets.reshaped()[i] = Jet(x.reshaped()[i], i);
    const Vec12 g_jet = fold_angle(jets).v;
    // both exact; the rounding of positions of 0.1 m is shared
    EXPECT_LE((fold_angle_gradient(x) - g_jet).norm(), 1e-12 * g_jet.norm()) << delta;
  }
}

TEST(DihedralAngle, GradientAgainstDifferences) {
  for (const double delta : {-2.5, -0.7, 0.0, 0.3, kPi / 2, 2.5}) {
    const Corners4<double> x = placed(folded(delta));
    const Vec12 g = fold_angle_gradient(x);
    const DerivativeError check = check_gradient(angle, x.reshaped(), g, 1e-2);
    EXPECT_LE(check.error, 1e-8) << check;
    Random random(1);
    EXPECT_NEAR(taylor_slope(angle, x.reshaped(), g, random_vector(12, random), 1e-5), 2, 0.1);
  }
}

TEST(DihedralAngle, RigidMotionsChangeNothing) {
  const Corners4<double> x = placed(folded(1.2));
  const Vec12 g = fold_angle_gradient(x);
  for (int axis = 0; axis < 3; ++axis) {
    Vec12 shift, rotation;
    for (int k = 0; k < 4; ++k) {
      shift.segment<3>(3 * k) = Vec3::Unit(axis);
      rotation.segment<3>(3 * k) = Vec3::Unit(axis).cross(x.col(k));
    }
    EXPECT_LE(std::abs(g.dot(shift)), 1e-13 * g.norm());
    EXPECT_LE(std::abs(g.dot(rotation)), 1e-13 * g.norm());
  }
}

}  // namespace
}  // namespace drape::test
