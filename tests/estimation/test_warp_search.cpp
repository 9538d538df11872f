// The direction of the warp found from the outlines of an anisotropic fabric.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/drape_protocol.h"
#include "estimation/warp_search.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

const std::vector<double> kStarts{M_PI / 2, 0.1};
constexpr double kTrueAngle = 0.3;

/// Four times stiffer along the weft than along the warp.
Fabric anisotropic_fabric() {
  Fabric fabric = stiff_fabric();
  fabric.k_bu = 4e-5;
  fabric.k_bv = 1e-5;
  return fabric;
}

/// Its drape as a picture with a turned weft shows it; fits start from that drape, so that its
/// branch is not in question.
Picture turned_picture() {
  const Potential potential(disc(300), anisotropic_fabric(), {}, kCusick.gravity);
  Picture picture{potential, kCusick, {}, drape_by_ramp(potential, 1)};
  const Outline outline = trace_outline(potential.mesh(), kCusick, picture.start_state->x);
  picture.seen.profile =
      radial_profile(Placement{Vec2::Zero(), kTrueAngle, 0}.seen(outline.points)).radius;
  picture.seen.weft_angle_sd = 0.4;
  return picture;
}

EstimateOptions short_options() {
  EstimateOptions options;
  options.parameters = {Parameter::k_bu, Parameter::k_bv};
  options.max_solves = 80;
  options.prior = prior_about({options.parameters, anisotropic_fabric()}, anisotropic_fabric(), 1);
  return options;
}

TEST(WarpSearch, KeepsTheBestOfItsStarts) {
  const WarpSearch search =
      estimate_with_warp({turned_picture()}, kStarts, anisotropic_fabric(), short_options());
  ASSERT_EQ(search.trials.size(), 2u);
  EXPECT_EQ(search.best.outcome, EstimateOutcome::succeeded) << search.best.message;
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(search.trials[i].weft_angle, kStarts[i]);
    EXPECT_EQ(search.trials[i].picture, 0u);
    if (search.trials[i].outcome == EstimateOutcome::succeeded) {
      EXPECT_LE(search.best.cost, search.trials[i].cost);
    }
  }
  EXPECT_LT(std::abs(search.pictures[0].seen.weft_angle - kTrueAngle), M_PI / 4);
  // the prior of the angle, 0.4 about the start, pulls a little
  EXPECT_NEAR(search.best.pictures[0].placement.weft_angle, kTrueAngle, 0.05);
}

TEST(WarpSearch, OneDirectionIsOneFit) {
  Picture picture = turned_picture();
  picture.seen.weft_angle_sd = 0;
  const WarpSearch search =
      estimate_with_warp({picture}, {kTrueAngle}, anisotropic_fabric(), short_options());
  ASSERT_EQ(search.trials.size(), 1u);
  EXPECT_EQ(search.best.outcome, EstimateOutcome::succeeded) << search.best.message;
  EXPECT_EQ(search.best.pictures[0].placement.weft_angle, kTrueAngle);
  EXPECT_LE(search.best.pictures[0].outline_rms, 1e-4);
  EXPECT_THROW(estimate_with_warp({picture}, {}, anisotropic_fabric(), short_options()),
               std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
