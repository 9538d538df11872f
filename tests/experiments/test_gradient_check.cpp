// The check of a gradient on small drapes: right derivatives pass, steps across a change of regime
// are left out, and two steps together are nearer to the derivative than one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/gradient_check.h"
#include "experiments/model.h"
#include "tests/experiments/small_drape.h"

namespace drape {
namespace {

Settings past_threshold() {
  Settings settings = test::small_drape();
  settings.reading.threshold = BendingThreshold::radius;
  settings.fabric.s_bu = settings.fabric.s_bv = settings.fabric.s_bh = 0.6;
  settings.gradient_check.steps = {3e-4, 1e-4, 3e-5, 1e-5, 3e-6};
  return settings;
}

GradientCheck checked(const Settings& settings) {
  return check_gradient(settings, make_discretization(settings), settings.fabric, 1);
}

class GradientCheckOf : public testing::TestWithParam<CheckedLoss> {};

TEST_P(GradientCheckOf, EveryDerivativeAgreesWithDifferences) {
  Settings settings = past_threshold();
  settings.gradient_check.loss = GetParam();
  const GradientCheck check = checked(settings);
  ASSERT_EQ(check.status, "ok");
  EXPECT_GT(check.wings_past_threshold, 0);
  EXPECT_LT(check.adjoint_versus_tangent, 1e-8);
  ASSERT_EQ(check.parameters.size(), settings.gradient_check.parameters.size());
  for (const ParameterCheck& c : check.parameters) EXPECT_LT(c.error, 1e-6) << name(c.parameter);
}

INSTANTIATE_TEST_SUITE_P(Losses, GradientCheckOf,
                         testing::Values(CheckedLoss::profile, CheckedLoss::coverage,
                                         CheckedLoss::drape_coefficient));

TEST(GradientCheckSteps, TwoStepsAreNearerThanEitherWhereTruncationErrs) {
  const GradientCheck check = checked(past_threshold());
  int nearer = 0, compared = 0;
  for (const ParameterCheck& c : check.parameters) {
    EXPECT_TRUE(std::isnan(c.extrapolated.front()));
    const double alone = std::abs(c.differences[1] - c.adjoint);
    const double together = std::abs(c.extrapolated[1] - c.adjoint);
    if (std::isnan(alone) || std::isnan(together)) continue;
    ++compared;
    nearer += together < alone;
  }
  EXPECT_GT(compared, 6);
  EXPECT_GE(nearer, compared - 2);
}

TEST(GradientCheckSteps, ThoseAcrossASnapOrAChangeOfRegimeAreLeftOut) {
  Settings settings = past_threshold();
  settings.gradient_check.steps = {0.1, 1e-5};
  const GradientCheck check = checked(settings);
  int excluded = 0;
  for (const ParameterCheck& c : check.parameters) {
    excluded += c.excluded;
    EXPECT_EQ(c.excluded,
              std::ranges::count_if(c.differences, [](double f) { return std::isnan(f); }));
    if (!c.excluded) continue;
    EXPECT_TRUE(std::isnan(c.extrapolated[1]));
    EXPECT_EQ(c.step, 1e-5);
  }
  EXPECT_GT(excluded, 0);
}

}  // namespace
}  // namespace drape
