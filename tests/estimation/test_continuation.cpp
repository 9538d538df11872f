#include <gtest/gtest.h>

#include <stdexcept>

#include "core/drape_protocol.h"
#include "estimation/continuation.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

/// The drape of a stiff fabric, the first point of its branch.
struct Branch {
  Branch()
      : potential(disc(300), stiff_fabric(), {}, kCusick.gravity),
        space{{Parameter::k_h, Parameter::k_bu, Parameter::k_bv, Parameter::k_bh}, stiff_fabric()},
        point(make_branch_point(potential, space, space.encode(stiff_fabric()),
                                drape_by_lobes(potential, kCusick, 4, 0, {.tolerance = 1e-11}))) {}

  Potential potential;
  ParameterSpace space;
  BranchPoint point;
};

const Branch& branch() {
  static const Branch b;
  return b;
}

const ContinuationOptions kTight{.equilibrium = {.tolerance = 1e-11}};

TEST(Continuation, ThereAndBackAgain) {
  const Branch& b = branch();
  const VecX change = Eigen::Vector4d(0.5, 0.4, -0.3, 0.2);
  Potential potential = b.potential;
  ContinuationCost cost;
  const auto there = follow_branch(potential, b.space, b.point, b.point.z + change, kTight, &cost);
  ASSERT_TRUE(there);
  EXPECT_EQ(there->z, b.point.z + change);
  EXPECT_EQ(potential.fabric().k_bu, b.space.decode(there->z).k_bu);
  EXPECT_EQ(there->equilibrium.protocol, b.point.equilibrium.protocol);
  EXPECT_GE(cost.solves, 2);  // 0.5 is more than one largest_step
  EXPECT_GE(cost.newton_iterations, cost.solves);
  EXPECT_GT(largest_distance(there->equilibrium.x, b.point.equilibrium.x), 1e-4);

  const auto back = follow_branch(potential, b.space, *there, b.point.z, kTight);
  ASSERT_TRUE(back);
  // a residual of 1e-11 over the smallest eigenvalue; another branch is millimetres away
  EXPECT_LE(largest_distance(back->equilibrium.x, b.point.equilibrium.x), 1e-6);
}

TEST(Continuation, PredictionIsOfSecondOrder) {
  const Branch& b = branch();
  const VecX direction = Eigen::Vector4d(0.5, 1, -0.7, 0.4);
  const auto deviation = [&](double step) {
    Potential potential = b.potential;
    potential.set_fabric(b.space.decode(b.point.z + step * direction));
    const VecX predicted = b.point.equilibrium.x + step * (b.point.dx_dz * direction);
    const Equilibrium e = solve_equilibrium(potential, predicted, {.tolerance = 1e-11});
    EXPECT_TRUE(e.converged());
    return largest_distance(e.x, predicted);
  };
  const double whole = deviation(0.02), half = deviation(0.01), quarter = deviation(0.005);
  EXPECT_NEAR(whole / half, 4, 0.4);  // the third-order term of a step of 2 %
  EXPECT_NEAR(half / quarter, 4, 0.2);
}

TEST(Continuation, AStepOfNothingStays) {
  const Branch& b = branch();
  Potential potential = b.potential;
  const auto same = follow_branch(potential, b.space, b.point, b.point.z, kTight);
  ASSERT_TRUE(same);
  EXPECT_LE(largest_distance(same->equilibrium.x, b.point.equilibrium.x), 1e-9);
}

TEST(Continuation, ALeapIsRefusedAtOnce) {
  const Branch& b = branch();
  ContinuationOptions options = kTight;
  options.largest_leap = 0.1;
  Potential potential = b.potential;
  ContinuationCost cost;
  const VecX direction = Eigen::Vector4d(1, 0.8, -0.6, 0.4);  // as far as above, without a snap
  EXPECT_FALSE(
      follow_branch(potential, b.space, b.point, b.point.z + 0.101 * direction, options, &cost));
  EXPECT_EQ(cost.solves, 0);
  EXPECT_TRUE(
      follow_branch(potential, b.space, b.point, b.point.z + 0.099 * direction, options, &cost));
  EXPECT_GT(cost.solves, 0);
}

TEST(Continuation, ALostBranchIsNothing) {
  const Branch& b = branch();
  ContinuationOptions options = kTight;
  options.noise = 0;
  options.largest_deviation = 1e-9;  // no curvature allowed: every step looks like a snap
  const VecX target = b.point.z + VecX::Constant(4, 0.1);
  for (const int halvings : {0, 3}) {
    options.halvings = halvings;
    Potential potential = b.potential;
    ContinuationCost cost;
    EXPECT_FALSE(follow_branch(potential, b.space, b.point, target, options, &cost));
    EXPECT_EQ(cost.solves, halvings + 1);
  }
}

TEST(Continuation, StartsFromMinimaOnly) {
  const Branch& b = branch();
  const Equilibrium stopped = solve_equilibrium(
      b.potential, folded_state(b.potential.mesh(), kCusick, 4, 0), {.max_iterations = 1});
  EXPECT_THROW(make_branch_point(b.potential, b.space, b.point.z, stopped), std::invalid_argument);
}

TEST(Continuation, LargestDistanceIsThatOfAVertex) {
  VecX a = VecX::Zero(6), b = a;
  b << 1, 2, 2, 0, 3, 0;
  EXPECT_EQ(largest_distance(a, b), 3);
  b[4] = -3.5;
  EXPECT_EQ(largest_distance(a, b), 3.5);
}

}  // namespace
}  // namespace drape::test
