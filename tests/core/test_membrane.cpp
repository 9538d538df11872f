#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "core/membrane.h"
#include "tests/support/derivative_check.h"
#include "tests/support/element_kernels.h"
#include "tests/support/hyper_dual.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

const MembraneStiffness kStiffness{1500, 900, 60};

using Mat9 = Eigen::Matrix<double, 9, 9>;

RestTriangle rest() { return one_triangle().rest[0]; }

Corners3<double> flat_corners() { return flat_state(one_triangle()).reshaped(3, 3); }

/// A triangle stretched, sheared and turned out of the plane.
Corners3<double> deformed(std::uint64_t seed, double amount = 0.3) {
  Random random(seed);
  return flat_corners() * (1 + amount * random.uniform(-1, 1)) +
         1e-2 * amount * random_vector(9, random).reshaped(3, 3);
}

/// The rest triangle scaled along u and v.
Corners3<double> scaled(double along_u, double along_v) {
  return Eigen::DiagonalMatrix<double, 3>(along_u, along_v, 1) * flat_corners();
}

Mat9 membrane_hessian(const RestTriangle& rest, const MembraneStiffness& k,
                      const Corners3<double>& x, double blend = 0) {
  return membrane_derivatives(rest, k, x, blend).hessian;
}

double energy(const VecX& x) {
  return membrane_energy<double>(rest(), kStiffness, Corners3<double>(x.reshaped(3, 3)));
}

TEST(Membrane, GradientAgainstDifferences) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Corners3<double> x = deformed(seed);
    const Vec9 g = membrane_gradient(rest(), kStiffness, x);
    const DerivativeError check = check_gradient(energy, x.reshaped(), g, 1e-2);
    EXPECT_LE(check.error, 1e-7)
        << check;  // central differences at their best: eps^(2/3), measured
    Random random(seed);
    // the third-order term bends the slope by about h
    EXPECT_NEAR(taylor_slope(energy, x.reshaped(), g, random_vector(9, random), 1e-5), 2, 0.1);
  }
}

TEST(Membrane, GradientAndHessianAgainstAutomaticDerivatives) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Corners3<double> x = deformed(seed);
    using Jet = ceres::Jet<double, 9>;
    Corners3<Jet> jets;
    for (int i = 0; i < 9; ++i) jets.reshaped()[i] = Jet(x.reshaped()[i], i);
    const Vec9 g_jet = membrane_energy<Jet>(rest(), kStiffness, jets).v;
    Vec9 g;
    Mat9 H;
    second_derivatives<9>(
        [](const auto& y) {
          return membrane_energy<HyperDual>(rest(), kStiffness,
                                            Corners3<HyperDual>(y.reshaped(3, 3)));
        },
        Vec9(x.reshaped()), g, H);
    EXPECT_LE((g_jet - g).norm(), 1e-12 * g.norm());
    // all are exact: only rounding is left
    EXPECT_LE((membrane_gradient(rest(), kStiffness, x) - g).norm(), 1e-12 * g.norm());
    const ElementDerivatives batched = membrane_derivatives(rest(), kStiffness, x);
    EXPECT_NEAR(batched.energy, energy(x.reshaped()), 1e-12 * batched.energy);
    EXPECT_LE((batched.gradient - g).norm(), 1e-12 * g.norm());
    EXPECT_LE((batched.hessian - H).norm(), 1e-12 * H.norm());
  }
}

TEST(Membrane, HessianAgreesWithDifferencesOfTheGradient) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Corners3<double> x = deformed(seed);
    const Mat9 H = membrane_hessian(rest(), kStiffness, x);
    const auto gradient = [](const VecX& y) -> VecX {
      return membrane_gradient(rest(), kStiffness, Corners3<double>(y.reshaped(3, 3)));
    };
    const DerivativeError check = check_jacobian(gradient, x.reshaped(), H, 1e-2);
    EXPECT_LE(check.error, 1e-7) << check;
  }
}

TEST(Membrane, GradientIsLinearInTheStiffnesses) {
  const Corners3<double> x = deformed(3);
  const Eigen::Matrix<double, 9, 3> dg = membrane_gradient_dstiffness(rest(), x);
  for (int p = 0; p < 3; ++p) {
    const auto gradient = [&](double value) -> VecX {
      MembraneStiffness k = kStiffness;
      (p == 0 ? k.k_u : p == 1 ? k.k_v : k.k_h) = value;
      return membrane_gradient(rest(), k, x);
    };
    const double value = p == 0 ? kStiffness.k_u : p == 1 ? kStiffness.k_v : kStiffness.k_h;
    const DerivativeError check = check_derivative(gradient, value, dg.col(p), value);
    EXPECT_LE(check.error, 1e-10) << p << ": " << check;  // linear: no truncation
  }
}

TEST(Membrane, RestStateHasNoEnergyAndNoForce) {
  EXPECT_LE(energy(flat_corners().reshaped()), 1e-30);
  // forces are rounding times k h, here 1500 N/m * 0.01 m * 1e-16
  EXPECT_LE(membrane_gradient(rest(), kStiffness, flat_corners()).norm(), 1e-13);
}

TEST(Membrane, RigidMotionsChangeNothing) {
  const Corners3<double> x = deformed(5);
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const Corners3<double> moved = (turn * x).colwise() + Vec3(0.3, -0.2, 0.1);
  const double e = energy(x.reshaped());
  EXPECT_NEAR(energy(moved.reshaped()), e, 1e-12 * e);  // rounding of positions of 0.3 m
  const Corners3<double> g = membrane_gradient(rest(), kStiffness, x).reshaped(3, 3);
  const Corners3<double> g_moved = membrane_gradient(rest(), kStiffness, moved).reshaped(3, 3);
  EXPECT_LE((g_moved - turn * g).norm(), 1e-12 * g.norm());
  // no net force and no net torque
  EXPECT_LE(g.rowwise().sum().norm(), 1e-14 * g.norm());
  Vec3 torque = Vec3::Zero();
  for (int k = 0; k < 3; ++k) torque += x.col(k).cross(g.col(k));
  EXPECT_LE(torque.norm(), 1e-14 * g.norm() * x.norm());
}

/// Second derivative of the energy per area along a displacement of the corners.
double modulus(const Corners3<double>& displacement, const Corners3<double>& second) {
  const Vec9 a = displacement.reshaped(), b = second.reshaped();
  return a.dot(membrane_hessian(rest(), kStiffness, flat_corners()) * b) / rest().area;
}

TEST(Membrane, SmallStrainModuli) {
  const Mat3 I = Mat3::Identity();
  const Corners3<double> x = flat_corners();
  const Corners3<double> along_u = I.col(0) * x.row(0), along_v = I.col(1) * x.row(1);
  const Corners3<double> shear = I.col(0) * x.row(1);
  const double rounding = 1e-10;  // of moduli of 1000 N/m
  EXPECT_NEAR(modulus(along_u, along_u), kStiffness.k_u + kStiffness.k_h / 2, rounding);
  EXPECT_NEAR(modulus(along_v, along_v), kStiffness.k_v + kStiffness.k_h / 2, rounding);
  EXPECT_NEAR(modulus(along_u, along_v), kStiffness.k_h / 2, rounding);
  EXPECT_NEAR(modulus(shear, shear), kStiffness.k_h / 2, rounding);
  EXPECT_NEAR(modulus(along_u, shear), 0, rounding);
}

TEST(Membrane, ARatioBelowOneIsResistedLikeOneAbove) {
  const MembraneStiffness only_u{1000, 0, 0};
  const double longer = membrane_energy<double>(rest(), only_u, scaled(1.1, 1));
  const double shorter = membrane_energy<double>(rest(), only_u, scaled(0.9, 1));
  EXPECT_NEAR(longer, 0.5 * 1000 * rest().area * 0.01, 1e-14 * 1000);  // Eq. 1
  EXPECT_NEAR(shorter, longer, 1e-14 * 1000);
}

TEST(Membrane, FullBlendIsPositiveSemidefiniteUnderCompressionOnly) {
  const Corners3<double> compressed = scaled(0.9, 0.85);
  const auto smallest = [](const Mat9& H) {
    return Eigen::SelfAdjointEigenSolver<Mat9>(H).eigenvalues()[0] / H.norm();
  };
  EXPECT_LT(smallest(membrane_hessian(rest(), kStiffness, compressed, 0)), -1e-3);
  EXPECT_GT(smallest(membrane_hessian(rest(), kStiffness, compressed, 1)), -1e-14);
  // halfway in between, and nothing to blend where all four directions are stretched
  const Mat9 half = (membrane_hessian(rest(), kStiffness, compressed, 0) +
                     membrane_hessian(rest(), kStiffness, compressed, 1)) /
                    2;
  EXPECT_LE((membrane_hessian(rest(), kStiffness, compressed, 0.5) - half).norm(),
            1e-14 * half.norm());
  const Corners3<double> stretched = scaled(1.1, 1.2);
  EXPECT_EQ(membrane_hessian(rest(), kStiffness, stretched, 0),
            membrane_hessian(rest(), kStiffness, stretched, 1));
}

}  // namespace
}  // namespace drape::test
