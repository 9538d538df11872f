#include <gtest/gtest.h>

#include <stdexcept>

#include "adjoint/adjoint.h"
#include "adjoint/loss.h"
#include "adjoint/sensitivity.h"
#include "tests/support/derivative_check.h"
#include "tests/support/solved_drape.h"

namespace drape::test {
namespace {

const SolvedDrape& drape() {
  static const SolvedDrape solved;
  return solved;
}

std::vector<Parameter> every_parameter() {
  return {all_parameters().begin(), all_parameters().end()};
}

TEST(Sensitivity, TransposedTimesMissIsTheAdjoint) {
  const SolvedDrape& d = drape();
  const VecX observed = VecX::Constant(kProfileSize, 0.12);
  for (const Vec2& centre : {Vec2(0, 0), Vec2(2e-3, -1e-3)}) {
    const Profile profile = radial_profile(d.outline.points, centre);
    const MatX dx_dp = sensitivities(d.potential, d.equilibrium, every_parameter());
    const MatX J = profile_sensitivities(d.outline, profile, centre, d.equilibrium.x, dx_dp);
    const ParameterVector by_tangent = J.transpose() * (profile.radius - observed) / kProfileSize;
    const Loss loss = profile_loss(d.outline, observed, centre);
    const ParameterVector by_adjoint = adjoint_gradient(
        d.potential, d.equilibrium, pull_back(d.outline, d.equilibrium.x, loss.dL_dpoints));
    const ParameterVector p = to_vector(d.potential.fabric());
    // the accuracy of the linear solves: condition number times rounding
    EXPECT_LE((by_tangent - by_adjoint).cwiseProduct(p).norm(),
              1e-8 * by_adjoint.cwiseProduct(p).norm());
  }
}

TEST(Sensitivity, AgainstDifferencesOfReSolvedEquilibria) {
  const SolvedDrape& d = drape();
  const Fabric fabric = d.potential.fabric();
  const MatX dx_dp = sensitivities(d.potential, d.equilibrium, every_parameter());
  const MatX per_share = dx_dp * to_vector(fabric).asDiagonal();
  Random random(2);
  for (int trial = 0; trial < 3; ++trial) {
    const ParameterVector direction = random_vector(kParameterCount, random);
    const VecX derivative = per_share * direction;
    double best = 1;
    for (const double step : {1e-4, 3e-5, 1e-5}) {
      const Equilibrium forward = d.solve(scaled(fabric, direction, step));
      const Equilibrium backward = d.solve(scaled(fabric, direction, -step));
      ASSERT_TRUE(forward.converged());
      ASSERT_TRUE(backward.converged());
      const VecX difference = (forward.x - backward.x) / (2 * step);
      best = std::min(best, (difference - derivative).norm() / derivative.norm());
    }
    EXPECT_LE(best, 1e-6) << trial;  // residual 1e-11 over the step, and step^2
  }
}

TEST(Sensitivity, ColumnsFollowTheListOfParameters) {
  const SolvedDrape& d = drape();
  const MatX all = sensitivities(d.potential, d.equilibrium, every_parameter());
  const MatX two =
      sensitivities(d.potential, d.equilibrium, {Parameter::k_bh, Parameter::areal_density});
  ASSERT_EQ(two.cols(), 2);
  const auto expect_same = [&](const VecX& a, Parameter p) {
    const VecX b = all.col(static_cast<int>(p));
    EXPECT_LE((a - b).norm(), 1e-10 * b.norm());  // blocked and single solves round differently
  };
  expect_same(two.col(0), Parameter::k_bh);
  expect_same(two.col(1), Parameter::areal_density);
}

TEST(Sensitivity, StiffnessAndWeightTogetherMoveNothing) {
  // x depends on stiffness over weight only: the sum of p dx/dp over density and all k vanishes
  const SolvedDrape& d = drape();
  const MatX dx_dp = sensitivities(d.potential, d.equilibrium, every_parameter());
  const MatX per_share = dx_dp * to_vector(d.potential.fabric()).asDiagonal();
  const VecX together = per_share.leftCols(7).rowwise().sum();      // density, k_u .. k_bh
  EXPECT_LE(together.norm(), 1e-7 * per_share.leftCols(7).norm());  // residual of 1e-11, amplified
}

TEST(Sensitivity, RefusesWhatIsNoConvergedMinimum) {
  const SolvedDrape& d = drape();
  const Equilibrium stopped = solve_equilibrium(
      d.potential, folded_state(d.potential.mesh(), kCusick, 5, 0), {.max_iterations = 1});
  EXPECT_THROW(sensitivities(d.potential, stopped, {Parameter::k_h}), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
