#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/coarse_level.h"
#include "core/drape_protocol.h"
#include "estimation/branch_search.h"
#include "estimation/staged_fit.h"
#include "tests/support/shapes.h"
#include "tests/support/soft_drape.h"

namespace drape::test {
namespace {

TEST(BranchSearch, TheFirstStartIsTheOneAskedFor) {
  const std::vector<GuidedStart> starts = guided_starts({2, 0.5}, 17);
  ASSERT_GT(starts.size(), 1u);
  EXPECT_EQ(starts.front().harmonics, 17);
  EXPECT_EQ(starts.front().kappa, 2);
  EXPECT_EQ(starts.front().bending, 1);
  for (const GuidedStart& start : starts) EXPECT_GE(start.kappa, 2);
  EXPECT_EQ(guided_starts({}, 24).front().kappa, 1);
}

TEST(BranchSearch, AnOutlineIsExplainedWhereNoiseWouldMissAsMuch) {
  // chi-square of 27 degrees of freedom, 31 values less four that are fitted: Wilson and Hilferty
  const auto miss_at = [](double deviations) {
    const double share = 2. / (9 * 27);
    return std::sqrt(27. / 31 * std::pow(1 - share + deviations * std::sqrt(share), 3));
  };
  EXPECT_TRUE(explains(miss_at(2.576)));        // 99.5 %
  EXPECT_FALSE(explains(miss_at(3.719)));       // 99.99 %
  EXPECT_TRUE(explains_well(miss_at(1.282)));   // 90 %
  EXPECT_FALSE(explains_well(miss_at(1.645)));  // 95 %
}

TEST(BranchSearch, OutcomeCountsBeforeMisfit) {
  EXPECT_TRUE(is_better(EstimateOutcome::misfit, 6, EstimateOutcome::branch_lost, 0.2));
  EXPECT_FALSE(is_better(EstimateOutcome::branch_lost, 0.2, EstimateOutcome::misfit, 6));
  EXPECT_TRUE(is_better(EstimateOutcome::misfit, 2, EstimateOutcome::misfit, 6));
  EXPECT_TRUE(is_better(EstimateOutcome::not_converged, 2, EstimateOutcome::misfit, 6));
  EXPECT_FALSE(is_better(EstimateOutcome::misfit, 6, EstimateOutcome::misfit, 6));
}

/// A fabric of the tag model with a much stiffer warp, and its drape by the ramp.
struct StiffWarp {
  StiffWarp()
      : potential(make_disc(kCusick, {.vertices = 500, .clamp_refinement = 1}), fabric(), {},
                  kCusick.gravity) {
    const Equilibrium drape = drape_by_ramp(potential, 1);
    seen.profile = radial_profile(trace_outline(potential.mesh(), kCusick, drape.x).points).radius;
    seen.noise = 1e-5;
  }

  static Fabric fabric() {
    Fabric fabric;
    fabric.areal_density = 0.136;
    fabric.k_u = 930.9;
    fabric.k_v = 1305;
    fabric.k_h = 136.9;
    fabric.k_bu = 6.447e-8;
    fabric.k_bv = 3.855e-6;
    fabric.k_bh = 6.447e-6;
    return fabric;
  }

  static Fabric start() {
    Fabric fabric = StiffWarp::fabric();
    fabric.k_h = 131.4;
    fabric.k_bu = 1.755e-7;
    fabric.k_bv = 8.356e-7;
    fabric.k_bh = 7.475e-6;
    return fabric;
  }

  Picture picture() const { return {potential, kCusick, seen}; }

  Potential potential;
  OutlineObservation seen;
};

const StiffWarp& stiff_warp() {
  static const StiffWarp drape;
  return drape;
}

TEST(BranchSearch, ANeighbourIsLeftForTheBranchObserved) {
  EstimateOptions options;
  options.max_restarts = options.max_pops = 0;
  options.max_moves = 0;
  const Estimate left_alone = estimate({stiff_warp().picture()}, StiffWarp::start(), options);
  EXPECT_EQ(standing(left_alone.outcome), standing(EstimateOutcome::misfit))
      << name(left_alone.outcome);
  options.max_moves = 100;
  options.max_solves = 1000;
  const Estimate moved = estimate({stiff_warp().picture()}, StiffWarp::start(), options);
  EXPECT_EQ(moved.outcome, EstimateOutcome::succeeded) << name(moved.outcome);
  EXPECT_LT(moved.pictures[0].outline_rms, 1.5e-5);
  EXPECT_GT(left_alone.pictures[0].outline_rms, 1e-4);
  const Fabric truth = StiffWarp::fabric();
  for (const Parameter k : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh})
    EXPECT_NEAR(moved.fabric[k] / truth[k], 1, 0.02) << name(k);
}

TEST(BranchSearch, WhatIsExplainedMayStillBeSearched) {
  EXPECT_TRUE(explains_well(1.09));
  EXPECT_FALSE(explains_well(1.11));
  EXPECT_TRUE(explains(1.29));
  EXPECT_FALSE(explains(1.31));
}

TEST(BranchSearch, EveryMoveEndsOnAFreeEquilibriumOrSaysThatItHasNone) {
  const Picture picture = stiff_warp().picture();
  const EstimateOptions options;
  StagedFit fit({picture}, StiffWarp::start(), options);
  ASSERT_TRUE(fit.lay_and_release({24, 1, 1}));
  const FitState first = fit.state();
  EXPECT_TRUE(fit.is_at(first));
  Potential free = picture.model;
  free.set_fabric(StiffWarp::start());
  int elsewhere = 0;
  for (const Move& move : neighbour_moves(24)) {
    fit.take_up(first);
    if (!move(fit)) continue;
    const Equilibrium& drape = fit.state().pictures[0].equilibrium;
    EXPECT_EQ(fit.state().kappa, 0);
    EXPECT_EQ(fit.state().u, first.u);
    EXPECT_EQ(drape.negative_eigenvalues, 0);
    EXPECT_LE(free.residual(free.gradient(drape.x)), std::max(1e-8, drape.rounding_floor));
    elsewhere += !fit.is_at(first);
  }
  EXPECT_GT(elsewhere, 0);
}

TEST(BranchSearch, ADrapeThatMissesNothingIsNotPulledAway) {
  EstimateOptions options;
  StagedFit fit({stiff_warp().picture()}, StiffWarp::fabric(), options);
  ASSERT_TRUE(fit.drape_freely(FreeDrape::lobes));
  Picture own = stiff_warp().picture();
  own.seen.profile = fit.profile_of(0);
  own.start_state = fit.state().pictures[0].equilibrium;
  StagedFit at_truth({own}, StiffWarp::fabric(), options);
  at_truth.take_start_states();
  const FitState truth = at_truth.state();
  ASSERT_TRUE(at_truth.overshoot(30));
  EXPECT_TRUE(at_truth.is_at(truth));
}

}  // namespace
}  // namespace drape::test
