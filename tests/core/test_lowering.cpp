#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "core/lowering.h"
#include "tests/support/derivative_check.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

TEST(Plate, CarriesAVertexAtItsGiveAndNothingAbove) {
  const Plate plate{.height = -0.02, .give = 1e-4};
  for (const double above : {0.0, 1e-12, 1e-3}) {
    const PlatePush push = plate_push(plate, plate.height + above);
    EXPECT_EQ(push.energy, 0);
    EXPECT_EQ(push.slope, 0);
    EXPECT_EQ(push.curvature, 0);
  }
  EXPECT_NEAR(plate_push(plate, plate.height - plate.give).slope, -1, 1e-12);  // its own weight
  // C2: the curvature grows from zero; rounding of the height is 1e-18 m over give^2
  EXPECT_NEAR(plate_push(plate, plate.height - 1e-9).curvature, 2e-9 / 1e-8, 1e-6);
}

TEST(Plate, DerivativesAgainstDifferences) {
  const Plate plate{.height = -0.02, .give = 1e-4};
  for (const double depth : {-5e-5, 2e-5, 1e-4, 7e-4}) {
    const VecX z = VecX::Constant(1, plate.height - depth);
    const PlatePush push = plate_push(plate, z[0]);
    // 1e-7: truncation and rounding of a central difference at its best step
    DerivativeError check =
        check_gradient([&](const VecX& q) { return plate_push(plate, q[0]).energy; }, z,
                       VecX::Constant(1, push.slope), 1e-4);
    EXPECT_LE(check.error, depth > 0 ? 1e-7 : 0.0) << check;
    check = check_gradient([&](const VecX& q) { return plate_push(plate, q[0]).slope; }, z,
                           VecX::Constant(1, push.curvature), 1e-4);
    EXPECT_LE(check.error, depth > 0 ? 1e-7 : 0.0) << check;
  }
}

/// A cloth that half of its vertices press into a plate.
struct Pressed {
  Pressed() : potential(disc(250), medium_fabric(), {}, 9.81) {
    x = shaken(potential.mesh(), flat_state(potential.mesh()), 1e-3);
    potential.set_plate(Plate{.height = 0, .give = 5e-4});
    without = potential;
    without->set_plate(std::nullopt);
    d = shaken(potential.mesh(), VecX::Zero(x.size()), 1, 7);
  }
  Potential potential;
  std::optional<Potential> without;
  VecX x, d;
};

TEST(Plate, PotentialAddsItsDerivatives) {
  const Pressed p;
  const Discretization& disc = p.potential.discretization();
  const auto added = [&](double t) {
    const VecX x = p.x + t * p.d;
    return p.potential.energy(x) - p.without->energy(x);
  };
  const auto added_slope = [&](double t) {
    const VecX x = p.x + t * p.d;
    return p.d.dot(p.potential.gradient(x) - p.without->gradient(x));
  };
  SparseMatrix H, H_without;
  p.potential.hessian(p.x, 0, H);
  p.without->hessian(p.x, 0, H_without);
  const VecX d = disc.to_free(p.d);
  const SparseMatrix difference = H - H_without;
  const double curvature = d.dot(difference.selfadjointView<Eigen::Lower>() * d);
  // 1e-6: the term is a difference of energies ten times as large
  DerivativeError check = check_gradient([&](const VecX& t) { return added(t[0]); }, VecX::Zero(1),
                                         VecX::Constant(1, added_slope(0)), 1e-4);
  EXPECT_LE(check.error, 1e-6) << check;
  check = check_gradient([&](const VecX& t) { return added_slope(t[0]); }, VecX::Zero(1),
                         VecX::Constant(1, curvature), 1e-4);
  EXPECT_LE(check.error, 1e-6) << check;
}

TEST(Plate, IsAsStrongAsTheClothIsHeavy) {
  const Pressed p;
  const double density = p.potential.fabric().areal_density;
  const auto gradient = [&](double change) {
    Potential heavier = p.potential;
    Fabric fabric = heavier.fabric();
    fabric.areal_density = density + change;
    heavier.set_fabric(fabric);
    return heavier.gradient(p.x);
  };
  const VecX difference = (gradient(0.01) - gradient(-0.01)) / 0.02;  // linear in the density
  const VecX column =
      p.potential.gradient_dfabric(p.x).col(static_cast<int>(Parameter::areal_density));
  EXPECT_LE((difference - column).cwiseAbs().maxCoeff(), 1e-10 * column.cwiseAbs().maxCoeff());
  EXPECT_NEAR(
      p.potential.gradient_dfabric_transposed(p.x, p.d)[static_cast<int>(Parameter::areal_density)],
      p.d.dot(column), 1e-12 * column.cwiseAbs().sum());
}

TEST(Lowering, EndsAtAMinimumWithoutThePlate) {
  Potential potential(disc(250), stiff_fabric(), {}, kCusick.gravity);
  const Equilibrium drape = drape_by_lowering(potential, {.largest_step = 1e-2});
  ASSERT_TRUE(drape.converged()) << name(drape.status);
  EXPECT_EQ(drape.negative_eigenvalues, 0);
  EXPECT_EQ(drape.protocol, "lowering");
  EXPECT_FALSE(potential.plate());
  EXPECT_LE(potential.residual(potential.gradient(drape.x)), 1e-8);
  EXPECT_LT(drape.x.minCoeff(), -5e-3);   // it hangs
  EXPECT_GT(drape.newton_iterations, 4);  // of all steps
}

TEST(Lowering, TheStepMustBePositive) {
  const Potential potential(disc(250), stiff_fabric(), {}, kCusick.gravity);
  for (const double step : {0.0, -1e-3, std::nan("")})
    EXPECT_THROW(drape_by_lowering(potential, {.largest_step = step}), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
