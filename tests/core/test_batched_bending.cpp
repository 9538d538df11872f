#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/batched_bending.h"
#include "tests/support/derivative_check.h"
#include "tests/support/element_kernels.h"
#include "tests/support/hyper_dual.h"

namespace drape::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kThreshold = 0.6;
using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

/// A wing of uneven triangles of 10 mm folded by delta, turned and shifted.
Corners4<double> folded(double delta) {
  const double half = delta / 2;
  Corners4<double> x;
  x.col(0) = Vec3(0, 0, 0);
  x.col(1) = Vec3(0.012, 0, 0);
  x.col(2) = Vec3(0.004, 0.009 * std::cos(half), 0.009 * std::sin(half));
  x.col(3) = Vec3(0.010, -0.013 * std::cos(half), 0.013 * std::sin(half));
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(0.3, 1, -0.6).normalized()).toRotationMatrix();
  return (turn * x).colwise() + Vec3(0.05, -0.1, 0.02);
}

WingLaw law(BendingLaw kind, double scale) {
  return {kind, Vec3(1, 0, 0), 3e-6, 1, scale, kThreshold, 0};
}

/// Flat, below, on either side of and past the threshold, folded upon itself.
const std::vector<double> kAngles = {0,        1e-9, -1e-4, 0.3, -0.599,    0.601,
                                     -kPi / 2, 2.5,  -3.0,  3.1, kPi - 1e-3};

TEST(BatchedBending, AgreesWithAutomaticDerivatives) {
  for (const BendingLaw kind : {BendingLaw::tangent, BendingLaw::secant})
    for (const double scale : {1.0, 0.4, 1e-3})  // the last: geometry dominates the Hessian
      for (const double delta : kAngles) {
        const WingLaw wing = law(kind, scale);
        const Corners4<double> x = folded(delta);
        Vec12 g;
        Mat12 H;
        second_derivatives<12>(
            [&](const auto& y) {
              return wing_energy(wing, fold_angle(Corners4<HyperDual>(y.reshaped(3, 4))));
            },
            Vec12(x.reshaped()), g, H);
        const ElementDerivatives batched = wing_derivatives(wing, x);
        const double energy = wing_energy(wing, fold_angle(x));
        // the rounding of positions of 0.1 m turns the wing by 1e-14 (see test_dihedral_angle)
        const double moment = 2 * wing.stiffness * std::abs(delta) + 2e-14 * wing.stiffness;
        EXPECT_NEAR(batched.energy, energy, 1e-12 * energy + 1e-13 * moment) << delta;
        const double rounding = 1e-13 * wing.stiffness * fold_angle_gradient(x).norm();
        EXPECT_LE((batched.gradient - g).norm(), 1e-12 * g.norm() + rounding) << delta;
        EXPECT_LE((batched.hessian - H).norm(), 1e-12 * H.norm()) << delta << ", " << scale;
      }
}

TEST(BatchedBending, FullBlendKeepsTheSemidefinitePart) {
  const WingLaw wing = law(BendingLaw::tangent, 0.4);
  for (const double delta : {-2.0, 0.3, 1.0}) {
    const MatX zero = wing_derivatives(wing, folded(delta), 0).hessian;
    const MatX half = wing_derivatives(wing, folded(delta), 0.5).hessian;
    const MatX full = wing_derivatives(wing, folded(delta), 1).hessian;
    const Vec12 d = fold_angle_gradient(folded(delta));
    const MatX expected = wing_tangent(wing, delta) * d * d.transpose();
    EXPECT_LE((full - expected).norm(), 1e-13 * expected.norm());
    EXPECT_LE((half - (zero + full) / 2).norm(), 1e-13 * zero.norm());
    const Eigen::SelfAdjointEigenSolver<MatX> eigen(zero);
    EXPECT_LT(eigen.eigenvalues()[0], -1e-3 * eigen.eigenvalues()[11]);  // so blending matters
  }
}

TEST(BatchedBending, AFoldIsInvariantUnderRigidMotions) {
  const Corners4<double> x = folded(1.2);
  const ElementDerivatives wing = wing_derivatives(law(BendingLaw::tangent, 0.4), x);
  for (int axis = 0; axis < 3; ++axis) {
    Vec12 shift, rotation, turned;
    for (int k = 0; k < 4; ++k) {
      shift.segment<3>(3 * k) = Vec3::Unit(axis);
      rotation.segment<3>(3 * k) = Vec3::Unit(axis).cross(x.col(k));
      turned.segment<3>(3 * k) = Vec3::Unit(axis).cross(Vec3(wing.gradient.segment<3>(3 * k)));
    }
    EXPECT_LE(std::abs(wing.gradient.dot(rotation)), 1e-13 * wing.gradient.norm());
    EXPECT_LE((wing.hessian * shift).norm(), 1e-13 * wing.hessian.norm());
    // d/dt of the rotated gradient: H (axis x x) = axis x g
    EXPECT_LE((wing.hessian * rotation - turned).norm(), 1e-13 * wing.hessian.norm());
  }
}

}  // namespace
}  // namespace drape::test
