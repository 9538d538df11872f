#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/drape_protocol.h"
#include "core/potential.h"
#include "core/support_contact.h"
#include "tests/support/derivative_check.h"
#include "tests/support/hyper_dual.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

const SupportContact kSupport = support_contact(kCusick);
constexpr double kWeight = 1e-3;  // [N]

/// A point p inside of the column's wall and q below the plane of the disc [m].
Vec3 inside(double p, double q, double alpha = 0.7) {
  const double r = kSupport.column_radius - p;
  return {r * std::cos(alpha), r * std::sin(alpha), -q};
}

/// Points near either face, near the rim and deep.
const std::vector<Vec3>& points_inside() {
  static const std::vector<Vec3> points{inside(1e-4, 2e-2), inside(2e-2, 1e-4),
                                        inside(1e-4, 1.3e-4), inside(5e-3, 4e-3, -2),
                                        inside(1e-3, 1e-2, 3)};
  return points;
}

TEST(SupportContact, PenetrationIsTheDistanceFromTheSurface) {
  EXPECT_DOUBLE_EQ(support_penetration(kSupport, {0.089, 0, -0.003}), 0.09 - 0.089);
  EXPECT_DOUBLE_EQ(support_penetration(kSupport, {0, -0.08, -0.003}), 0.003);
  EXPECT_EQ(support_penetration(kSupport, {0.08, 0, 0}), 0);        // on the disc
  EXPECT_EQ(support_penetration(kSupport, {0.08, 0, 1e-3}), 0);     // above
  EXPECT_EQ(support_penetration(kSupport, {0.0901, 0, -0.02}), 0);  // beside
}

TEST(SupportContact, DepthIsWithinASquareRootOfTwoOfThePenetration) {
  for (const Vec3& point : points_inside()) {
    const double depth = support_depth(kSupport, point).value;
    const double distance = support_penetration(kSupport, point);
    EXPECT_LE(depth, distance);
    EXPECT_GE(depth, distance / std::sqrt(2) * (1 - 1e-14));
  }
}

TEST(SupportContact, DerivativesOfTheDepthAgainstHyperDualNumbers) {
  for (const Vec3& point : points_inside()) {
    Vec3 gradient;
    Mat3 hessian;
    second_derivatives<3>(
        [](const Eigen::Matrix<HyperDual, 3, 1>& x) {
          const HyperDual p = HyperDual(kSupport.column_radius) - sqrt(x[0] * x[0] + x[1] * x[1]);
          return -(p * x[2]) / sqrt(p * p + x[2] * x[2]);
        },
        point, gradient, hessian);
    const SupportDepth depth = support_depth(kSupport, point);
    EXPECT_LE((depth.gradient - gradient).norm(), 1e-13);  // rounding, lengths of 1e-4 of 0.1 m
    EXPECT_LE((depth.hessian - hessian).norm(), 1e-11 * hessian.norm());
  }
}

TEST(SupportContact, DerivativesOfTheEnergyAgainstDifferences) {
  for (const Vec3& point : points_inside()) {
    const double length = support_penetration(kSupport, point);
    DerivativeError check =
        check_gradient([](const VecX& x) { return support_energy(kSupport, kWeight, Vec3(x)); },
                       point, support_gradient(kSupport, kWeight, point), length);
    EXPECT_LE(check.error, 1e-8) << check;
    check = check_jacobian(
        [](const VecX& x) -> VecX { return support_gradient(kSupport, kWeight, Vec3(x)); }, point,
        support_hessian(kSupport, kWeight, point, 0), length);
    EXPECT_LE(check.error, 1e-8) << check;
  }
}

TEST(SupportContact, NothingOutsideAndTwiceDifferentiableAcrossTheSurface) {
  const double deep = support_hessian(kSupport, kWeight, inside(1e-3, 1e-2), 0).norm();
  for (const double step : {1e-6, 1e-9}) {
    for (const Vec3& outside : {inside(-step, 1e-2), inside(1e-2, -step), inside(-step, step),
                                inside(step, -step), inside(-step, -step)}) {
      EXPECT_EQ(support_energy(kSupport, kWeight, outside), 0);
      EXPECT_EQ(support_gradient(kSupport, kWeight, outside), Vec3::Zero());
      EXPECT_EQ(support_hessian(kSupport, kWeight, outside, 0), Mat3::Zero());
    }
    // the Hessian falls with the depth: at the wall, at the plane and at the rim
    for (const Vec3& just_inside : {inside(step, 1e-2), inside(1e-2, step), inside(step, step)})
      EXPECT_LE(support_hessian(kSupport, kWeight, just_inside, 0).norm(), 3e3 * step * deep);
  }
}

TEST(SupportContact, FullBlendLeavesAPositiveSemidefiniteHessian) {
  for (const Vec3& point : points_inside()) {
    const Mat3 full = support_hessian(kSupport, kWeight, point, 0);
    const Mat3 safe = support_hessian(kSupport, kWeight, point, 1);
    EXPECT_LT(full.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
    EXPECT_GE(safe.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-15 * safe.norm());
    // what the blend removes is negative, and removed linearly
    EXPECT_LE((full - safe).selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff(),
              1e-15 * safe.norm());
    EXPECT_LE((support_hessian(kSupport, kWeight, point, 0.3) - (0.7 * full + 0.3 * safe)).norm(),
              1e-15 * safe.norm());
  }
}

TEST(SupportContact, ANarrowColumnLeavesRoomUnderTheDisc) {
  Scene scene;
  scene.column_radius = 0.05;
  validate(scene);
  EXPECT_EQ(support_penetration(support_contact(scene), inside(2e-3, 1e-2)), 0);
  EXPECT_DOUBLE_EQ(support_penetration(support_contact(scene), {0, 0.048, -1}), 0.05 - 0.048);
  scene.column_radius = 0.091;  // wider than the disc
  EXPECT_THROW(validate(scene), std::invalid_argument);
  scene.column_radius = -0.01;
  EXPECT_THROW(validate(scene), std::invalid_argument);
}

/// A drape with lobes under the rim of the support and others outside.
class SupportedPotential : public testing::Test {
 protected:
  SupportedPotential()
      : potential(disc(300), medium_fabric(), {}, kCusick.gravity),
        outside(folded_state(potential.mesh(), kCusick, 6, 0.2)),
        x(outside) {
    for (int v : potential.discretization().free_vertices())
      if (std::cos(6 * std::atan2(x[3 * v + 1], x[3 * v])) > 0) {
        const double r = x.segment<2>(3 * v).norm();
        x.segment<2>(3 * v) *= (0.09 - 0.1 * (r - 0.09)) / r;
      }
    without = std::make_unique<Potential>(potential);
    potential.set_support(kSupport);
  }
  Potential potential;
  std::unique_ptr<Potential> without;
  VecX outside, x;
};

TEST_F(SupportedPotential, OutsideEverythingIsBitEqual) {
  ASSERT_EQ(support_penetration(kSupport, potential.mesh(), outside), 0);
  SparseMatrix with_support, plain;
  potential.hessian(outside, 0, with_support);
  without->hessian(outside, 0, plain);
  EXPECT_EQ(potential.energy(outside), without->energy(outside));
  EXPECT_EQ(potential.gradient(outside), without->gradient(outside));
  EXPECT_EQ((with_support - plain).norm(), 0);
  EXPECT_EQ(potential.gradient_dfabric(outside), without->gradient_dfabric(outside));
}

TEST_F(SupportedPotential, DerivativesInside) {
  ASSERT_GT(support_penetration(kSupport, potential.mesh(), x), 2e-3);
  // the support's part alone: the cloth's has a test of its own
  const auto energy = [&](const VecX& y) { return potential.energy(y) - without->energy(y); };
  const auto gradient = [&](const VecX& y) -> VecX {
    return potential.gradient(y) - without->gradient(y);
  };
  EXPECT_LE((gradient(x) + potential.contact_force(x)).norm(),
            1e-14 * potential.gradient(x).norm());
  SparseMatrix H, H_without;
  potential.hessian(x, 0, H);
  without->hessian(x, 0, H_without);
  const MatX part = full_matrix(H) - full_matrix(H_without);
  const Discretization& d = potential.discretization();
  Random random(2);
  for (int trial = 0; trial < 3; ++trial) {
    const VecX direction = random_vector(3 * d.free_vertex_count(), random);
    const VecX along = d.to_full(direction);
    DerivativeError check =
        check_derivative([&](double t) -> VecX { return VecX::Constant(1, energy(x + t * along)); },
                         0, VecX::Constant(1, gradient(x).dot(along)), 1e-4);
    EXPECT_LE(check.error, 1e-7) << check;
    check = check_derivative([&](double t) -> VecX { return d.to_free(gradient(x + t * along)); },
                             0, part* direction, 1e-4);
    EXPECT_LE(check.error, 1e-7) << check;
  }
  const VecX force = potential.contact_force(x);
  EXPECT_EQ(d.to_full(d.to_free(force)), force) << "fixed vertices feel nothing";
}

TEST_F(SupportedPotential, TheForceIsProportionalToDensity) {
  const MatX dg = potential.gradient_dfabric(x);
  const VecX density = VecX::Constant(1, medium_fabric().areal_density);
  const DerivativeError check = check_derivative(
      [&](double value) -> VecX {
        Fabric fabric = medium_fabric();
        fabric.areal_density = value;
        Potential other = potential;
        other.set_fabric(fabric);
        return other.gradient(x);
      },
      density[0], dg.col(static_cast<int>(Parameter::areal_density)), 0.01);
  EXPECT_LE(check.error, 1e-9) << check;
  Random random(4);
  const VecX lambda = potential.discretization().to_full(
      potential.discretization().to_free(random_vector(x.size(), random)));
  const VecX transposed = potential.gradient_dfabric_transposed(x, lambda);
  EXPECT_LE((transposed - dg.transpose() * lambda).norm(), 1e-12 * transposed.norm());
}

}  // namespace
}  // namespace drape::test
