#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/drape_protocol.h"
#include "estimation/drape_objective.h"
#include "tests/support/derivative_check.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

const ContinuationOptions kTight{.equilibrium = {.tolerance = 1e-11, .max_iterations = 80}};

/// A drape of a stiff fabric and what would be seen of a disc with four shallow folds instead.
struct Case {
  Case()
      : potential(disc(300), stiff_fabric(), {}, kCusick.gravity),
        space{{Parameter::k_h, Parameter::k_bu, Parameter::k_bh}, stiff_fabric()},
        point(make_branch_point(potential, space, space.encode(stiff_fabric()),
                                drape_by_lobes(potential, kCusick, 4, 0.1, {.tolerance = 1e-11}))) {
    const Outline outline = trace_outline(potential.mesh(), kCusick, point.equilibrium.x);
    own_profile = radial_profile(outline.points).radius;
    Points2 polygon(kProfileSize, 2);
    seen.profile.resize(kProfileSize);
    for (int i = 0; i < kProfileSize; ++i) {
      const double alpha = 2 * M_PI * i / kProfileSize;
      seen.profile[i] = 0.12 + 0.008 * std::cos(4 * alpha + 0.4);
      polygon.row(i) = seen.profile[i] * Vec2(std::cos(alpha), std::sin(alpha));
    }
    seen.grid = centred_grid(128, 0.32);
    seen.coverage = coverage(polygon, seen.grid);
  }

  DrapeObjective objective(OutlineLoss loss, double prior_log_sd, bool centre_known = true,
                           int max_solves = 100000) const {
    OutlineObservation observation = seen;
    observation.centre_known = centre_known;
    DrapeObjective made(potential, kCusick, space, std::move(observation), loss, prior_log_sd,
                        max_solves);
    made.start_from(potential, point, kTight);
    return made;
  }

  /// Away from the prior's mean and, where the centre is unknown, from the axis.
  VecX unknowns(const DrapeObjective& objective) const {
    VecX u(objective.unknowns());
    u.head(3) = point.z + Eigen::Vector3d(0.03, -0.02, 0.04);
    if (u.size() > 3) u.tail(2) << 1.3, -0.7;
    return u;
  }

  Potential potential;
  ParameterSpace space;
  BranchPoint point;
  VecX own_profile;
  OutlineObservation seen;
};

const Case& stiff() {
  static const Case c;
  return c;
}

VecX residuals(DrapeObjective& objective, const VecX& u) {
  VecX r;
  if (!objective.residuals_at(u, r, nullptr)) throw std::runtime_error("branch lost");
  return r;
}

double cost(DrapeObjective& objective, const VecX& u) {
  double value;
  if (!objective.cost_at(u, value, nullptr)) throw std::runtime_error("branch lost");
  return value;
}

/// Central differences of f at the best of three steps, relative to the largest entry: a corner of
/// the outline that passes from one edge to the next bends f.
template <typename Function>
double error_against_differences(const Function& f, const VecX& u, const MatX& J) {
  double best = 1;
  for (const double h : {1e-3, 1e-4, 1e-5}) {
    MatX difference(J.rows(), J.cols());
    for (Eigen::Index j = 0; j < u.size(); ++j) {
      const VecX step = h * VecX::Unit(u.size(), j);
      difference.col(j) = (f(u + step) - f(u - step)) / (2 * h);
    }
    best = std::min(best, (difference - J).norm() / J.norm());
  }
  return best;
}

TEST(DrapeObjective, SizesAndPrior) {
  DrapeObjective plain = stiff().objective(OutlineLoss::profile, 0);
  EXPECT_EQ(plain.unknowns(), 3);
  EXPECT_EQ(plain.residuals(), kProfileSize);
  DrapeObjective whole = stiff().objective(OutlineLoss::profile, 0.5, false);
  EXPECT_EQ(whole.unknowns(), 5);
  EXPECT_EQ(whole.residuals(), kProfileSize + 3);
  const VecX u = stiff().unknowns(whole);
  EXPECT_EQ(whole.centre_of(u), 1e-3 * Vec2(1.3, -0.7));
  EXPECT_EQ(plain.centre_of(u.head(3)), Vec2::Zero());
  const VecX prior = residuals(whole, u).tail(3);
  EXPECT_LE((prior - Eigen::Vector3d(0.06, -0.04, 0.08)).norm(), 1e-14);  // rounding of z
}

TEST(DrapeObjective, OneUniformMillimetre) {
  for (const double miss : {0.0, 1e-3}) {
    Case off = stiff();
    off.seen.profile = off.own_profile.array() + miss;
    DrapeObjective objective = off.objective(OutlineLoss::profile, 0);
    // 61 independent radii, each off by 1 mm = 2 standard deviations
    EXPECT_NEAR(cost(objective, off.point.z), miss > 0 ? 0.5 * 61 * 4 : 0, 1e-9);
  }
}

TEST(DrapeObjective, JacobianAgainstDifferences) {
  for (const double prior : {0.0, 0.5})
    for (const bool centre_known : {true, false}) {
      DrapeObjective objective = stiff().objective(OutlineLoss::profile, prior, centre_known);
      const VecX u = stiff().unknowns(objective);
      VecX r;
      MatX J;
      ASSERT_TRUE(objective.residuals_at(u, r, &J));
      EXPECT_EQ(J.rows(), objective.residuals());
      EXPECT_EQ(J.cols(), objective.unknowns());
      const auto f = [&](const VecX& v) { return residuals(objective, v); };
      // one of the 360 rays at a corner of the outline within the step: it is off by its share
      EXPECT_LE(error_against_differences(f, u, J), 1e-4) << prior << " " << centre_known;
    }
}

TEST(DrapeObjective, AdjointGradientIsThatOfTheResiduals) {
  for (const double prior : {0.0, 0.5})
    for (const bool centre_known : {true, false}) {
      DrapeObjective objective = stiff().objective(OutlineLoss::profile, prior, centre_known);
      const VecX u = stiff().unknowns(objective);
      VecX r, gradient;
      MatX J;
      double value;
      ASSERT_TRUE(objective.residuals_at(u, r, &J));
      ASSERT_TRUE(objective.cost_at(u, value, &gradient));
      EXPECT_NEAR(value, 0.5 * r.squaredNorm(), 1e-12 * value);  // rounding of the sums
      // two routes through one factor: rounding times its condition
      EXPECT_LE((gradient - J.transpose() * r).norm(), 1e-6 * gradient.norm());
    }
}

TEST(DrapeObjective, CoverageGradientAgainstDifferences) {
  for (const double prior : {0.0, 0.5}) {
    DrapeObjective objective = stiff().objective(OutlineLoss::coverage, prior);
    const VecX u = stiff().unknowns(objective);
    double value;
    VecX gradient;
    ASSERT_TRUE(objective.cost_at(u, value, &gradient));
    const auto f = [&](const VecX& v) -> VecX { return VecX::Constant(1, cost(objective, v)); };
    // the curvature jumps where the outline enters a pixel
    EXPECT_LE(error_against_differences(f, u, gradient.transpose()), 1e-4) << prior;
  }
}

TEST(DrapeObjective, AMissOfOneDeviationCostsTheSameInBothLosses) {
  // the drape's own outline, larger all round by one standard deviation of a radius
  OutlineObservation larger;
  larger.noise = 2e-3;
  const double factor = 1 + larger.noise / stiff().own_profile.mean();
  const Points2 own =
      trace_outline(stiff().potential.mesh(), kCusick, stiff().point.equilibrium.x).points;
  larger.profile = factor * stiff().own_profile;
  larger.grid = centred_grid(1024, 0.34);
  larger.coverage = coverage(factor * own, larger.grid);
  const auto cost_in = [&](OutlineLoss loss) {
    DrapeObjective objective(stiff().potential, kCusick, stiff().space, larger, loss, 0, 1);
    objective.start_from(stiff().potential, stiff().point, kTight);
    return cost(objective, stiff().point.z);
  };
  // partly covered pixels of 0.33 mm on both sides of a band of 2 mm: a third of a pixel in all
  EXPECT_NEAR(cost_in(OutlineLoss::coverage) / cost_in(OutlineLoss::profile), 1, 0.1);
}

TEST(DrapeObjective, SpentSolvesAreRefused) {
  DrapeObjective objective = stiff().objective(OutlineLoss::profile, 0, true, 1);
  const VecX near = stiff().unknowns(objective);
  EXPECT_NE(objective.drape_at(stiff().point.z), nullptr);  // known, nothing to solve
  EXPECT_EQ(objective.work().solves, 0);
  EXPECT_NE(objective.drape_at(near), nullptr);
  EXPECT_EQ(objective.work().solves, 1);
  VecX r, gradient;
  double value;
  const VecX other = near.array() + 0.01;
  EXPECT_EQ(objective.drape_at(other), nullptr);
  EXPECT_FALSE(objective.residuals_at(other, r, nullptr));
  EXPECT_FALSE(objective.cost_at(other, value, &gradient));
  EXPECT_NE(objective.drape_at(near), nullptr);  // still known
  EXPECT_EQ(objective.work().solves, 1);
}

TEST(DrapeObjective, StartFromForgetsTheOtherDrapes) {
  DrapeObjective objective = stiff().objective(OutlineLoss::profile, 0);
  const VecX near = stiff().unknowns(objective);
  ASSERT_NE(objective.drape_at(near), nullptr);
  const int before = objective.work().solves;
  objective.start_from(stiff().potential, stiff().point, kTight);
  ASSERT_NE(objective.drape_at(near), nullptr);
  EXPECT_GT(objective.work().solves, before);
}

TEST(DrapeObjective, RefusesBadObservations) {
  const auto make = [](OutlineLoss loss, const OutlineObservation& observation) {
    DrapeObjective(stiff().potential, kCusick, stiff().space, observation, loss, 0, 1);
  };
  OutlineObservation observation = stiff().seen;
  EXPECT_NO_THROW(make(OutlineLoss::coverage, observation));
  observation.centre_known = false;
  EXPECT_NO_THROW(make(OutlineLoss::profile, observation));
  EXPECT_THROW(make(OutlineLoss::coverage, observation), std::invalid_argument);
  observation.noise = 0;
  EXPECT_THROW(make(OutlineLoss::profile, observation), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
