// Recovery of the parameters of a stiff fabric from its own outline; the protocol over many fabrics
// is an experiment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/disc_mesh.h"
#include "core/drape_protocol.h"
#include "estimation/estimate.h"
#include "tests/support/shapes.h"
#include "tests/support/soft_drape.h"

namespace drape::test {
namespace {

/// The drape of a stiff fabric, seen without noise.
struct Truth {
  Truth()
      : potential(disc(400), stiff_fabric(), {}, kCusick.gravity),
        equilibrium(drape_by_ramp(potential, 1)) {
    const Outline outline = trace_outline(potential.mesh(), kCusick, equilibrium.x);
    seen.profile = radial_profile(outline.points).radius;
  }

  /// A start with every unknown parameter wrong by a factor of two, up and down.
  Fabric start() const {
    Fabric fabric = stiff_fabric();
    fabric.k_h *= 2;
    fabric.k_bu /= 2;
    fabric.k_bv *= 2;
    fabric.k_bh /= 2;
    return fabric;
  }

  Picture picture(std::optional<Equilibrium> start_state = std::nullopt) const {
    return {potential, kCusick, seen, std::move(start_state)};
  }

  Potential potential;
  Equilibrium equilibrium;
  OutlineObservation seen;
};

const Truth& truth() {
  static const Truth t;
  return t;
}

/// Largest |ln(estimate / truth)| over the bending stiffnesses, and that of k_h.
struct RecoveryError {
  double bending, shear;
};

RecoveryError recovery_error(const Estimate& estimate) {
  const auto error = [&](Parameter p) {
    return std::abs(std::log(estimate.fabric[p] / stiff_fabric()[p]));
  };
  return {std::max({error(Parameter::k_bu), error(Parameter::k_bv), error(Parameter::k_bh)}),
          error(Parameter::k_h)};
}

// Exact data: what remains is where the fit stops, a cost of 1e-5, which is a miss of far less than
// the noise; k_h hardly shows in the outline of a stiff fabric.
void expect_recovered(const Estimate& found) {
  EXPECT_EQ(found.outcome, EstimateOutcome::succeeded) << name(found.outcome) << found.message;
  EXPECT_TRUE(found.pictures[0].equilibrium.converged());
  EXPECT_EQ(found.pictures[0].equilibrium.negative_eigenvalues, 0);
  EXPECT_EQ(found.kappa, 0);
  EXPECT_LE(recovery_error(found).bending, 0.02);
  EXPECT_LE(recovery_error(found).shear, 0.1);
  EXPECT_LE(found.pictures[0].outline_rms, 1e-5);
  ASSERT_EQ(found.posterior.log_sd.size(), 4);
  EXPECT_TRUE(found.posterior.log_sd.allFinite());
  EXPECT_GT(found.posterior.log_sd.minCoeff(), 0);
  EXPECT_GT(found.forward_solves, found.iterations / 2);
  testing::Test::RecordProperty("solves", found.forward_solves);
}

TEST(Estimate, GuidedLevenbergMarquardt) {
  const Estimate found = estimate({truth().picture()}, truth().start(), {});
  expect_recovered(found);
  EXPECT_EQ(found.pictures[0].equilibrium.protocol, "guided");
  EXPECT_EQ(found.start.k_bu, truth().start().k_bu);
  EXPECT_EQ(found.fabric.k_u, stiff_fabric().k_u);  // not asked for
}

TEST(Estimate, GuidedBfgs) {
  EstimateOptions options;
  options.method = FitMethod::bfgs;
  expect_recovered(estimate({truth().picture()}, truth().start(), options));
}

TEST(Estimate, BothMethodsAgreeOnTwoPicturesWithNuisances) {
  // specimens of two sizes; the second picture is turned, shifted and magnified
  const Scene small{.specimen_radius = 0.12};
  const Potential model(std::make_shared<const Discretization>(
                            make_disc_mesh(small, {.vertices = 250, .clamp_refinement = 1}),
                            default_factor_backend()),
                        stiff_fabric(), {}, small.gravity);
  const Placement place{{1e-3, -2e-3}, 0.1, 0.004};
  const Outline outline = trace_outline(model.mesh(), small, drape_by_ramp(model, 1).x);
  Picture second{model, small, {}};
  second.seen.profile = radial_profile(place.seen(outline.points)).radius;
  second.seen.centre_known = false;
  second.seen.weft_angle_sd = 0.2;
  second.seen.scale_log_sd = 0.01;
  EstimateOptions options;
  options.prior = prior_about({options.parameters, stiff_fabric()}, truth().start(), 1);
  options.guide = {0.1};
  std::vector<Estimate> found;
  for (const FitMethod method : {FitMethod::levenberg_marquardt, FitMethod::bfgs}) {
    options.method = method;
    found.push_back(estimate({truth().picture(), second}, truth().start(), options));
    EXPECT_EQ(found.back().outcome, EstimateOutcome::succeeded) << found.back().message;
    EXPECT_LE(recovery_error(found.back()).bending, 0.1);  // the priors pull
    // the angle hardly shows: folds may lie in a turned picture as they lie in a turned fabric
    EXPECT_LE((found.back().pictures[1].placement.centre - place.centre).norm(), 1e-3);
  }
  // where the last relative change of the cost was below 1e-6, far within a standard deviation
  EXPECT_NEAR(found[0].cost, found[1].cost, 1e-2);
  EXPECT_NEAR(found[0].pictures[1].placement.weft_angle, found[1].pictures[1].placement.weft_angle,
              1e-3);
  const ParameterSpace space{options.parameters, stiff_fabric()};
  const VecX apart = space.encode(found[0].fabric) - space.encode(found[1].fabric);
  EXPECT_LE(apart.cwiseQuotient(found[0].posterior.log_sd).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Estimate, ContinuedFromTheDrapeOfTheStart) {
  // The start's drape on the branch of the observation: continued from the truth. All parameters
  // are wrong in one direction: from truth().start() this fit stops at a miss of 0.6 mm.
  Potential potential = truth().potential;
  const EstimateOptions options;
  Fabric stiffer = stiff_fabric();
  for (const Parameter p : options.parameters) stiffer[p] *= 2;
  const ParameterSpace space{options.parameters, stiffer};
  const auto start = follow_branch(
      potential, space,
      make_branch_point(potential, space, space.encode(stiff_fabric()), truth().equilibrium),
      space.encode(stiffer), {});
  ASSERT_TRUE(start);
  expect_recovered(estimate({truth().picture(start->equilibrium)}, stiffer, options));
}

TEST(Estimate, AnIterationLimitIsAnOutcome) {
  EstimateOptions options;
  options.max_iterations = 1;
  options.max_restarts = options.max_pops = 0;
  options.max_moves = 0;
  options.parameters = {Parameter::k_bu, Parameter::k_bv};
  const Estimate found = estimate({truth().picture()}, truth().start(), options);
  EXPECT_EQ(found.outcome, EstimateOutcome::not_converged) << found.message;
}

TEST(Estimate, NoGuidedDrapeIsAnOutcome) {
  EstimateOptions options;
  options.equilibrium.max_iterations = 1;
  const Estimate found = estimate({truth().picture()}, truth().start(), options);
  EXPECT_EQ(found.outcome, EstimateOutcome::no_start);
  EXPECT_EQ(found.fabric.k_bu, truth().start().k_bu);
}

TEST(Estimate, ContactIsDecidedAtTheStartAndHeld) {
  // an outline so narrow between its folds that a strong guide draws the cloth under the rim
  OutlineObservation seen;
  seen.profile.resize(kProfileSize);
  for (int i = 0; i < kProfileSize; ++i)
    seen.profile[i] = 0.097 + 0.012 * std::cos(6 * 2 * M_PI * i / kProfileSize);
  const Potential model(disc(300), soft_fabric(), {}, kCusick.gravity);
  EstimateOptions options;
  options.parameters = {Parameter::k_bh};
  options.max_iterations = 1;
  options.guide = {10};
  seen.noise = 1;  // any drape explains this outline: one start

  const Estimate held = estimate({{model, kCusick, seen}}, soft_fabric(), options);
  EXPECT_NE(held.outcome, EstimateOutcome::no_start);
  EXPECT_TRUE(held.pictures[0].contact.checked);
  EXPECT_TRUE(held.pictures[0].contact.support);
  EXPECT_EQ(held.pictures[0].contact.reason.find("Switched on: without it"), 0u)
      << held.pictures[0].contact.reason;
  EXPECT_LE(held.pictures[0].contact.penetration, 5e-4);  // of the penalty: measured 0.38 mm

  options.contact = ContactMode::off;
  const Estimate without = estimate({{model, kCusick, seen}}, soft_fabric(), options);
  EXPECT_FALSE(without.pictures[0].contact.support);
  EXPECT_EQ(without.pictures[0].contact.reason.find("Switched off by the settings"), 0u)
      << without.pictures[0].contact.reason;
  EXPECT_EQ(without.pictures[0].contact_doubtful,
            without.pictures[0].contact.penetration > kAllowedPenetration);
}

TEST(Estimate, FromAStateInContactContactIsHeld) {
  Potential model(disc(300), soft_fabric(), {}, kCusick.gravity);
  const ContactDrape target = drape_with_contact(
      model, kCusick, ContactMode::automatic,
      [](const Potential& potential) { return drape_by_lobes(potential, kCusick, 6, 0.1); });
  ASSERT_TRUE(target.equilibrium.converged());
  ASSERT_TRUE(target.contact.support);
  OutlineObservation seen;
  const Outline outline = trace_outline(model.mesh(), kCusick, target.equilibrium.x);
  seen.profile = radial_profile(outline.points).radius;
  EstimateOptions options;
  options.parameters = {Parameter::k_bu, Parameter::k_bh};
  const Estimate found =
      estimate({{model, kCusick, seen, target.equilibrium}}, soft_fabric(), options);
  EXPECT_EQ(found.outcome, EstimateOutcome::succeeded) << found.message;
  EXPECT_TRUE(found.pictures[0].contact.support);
  EXPECT_FALSE(found.pictures[0].contact_doubtful);
  EXPECT_LE(found.pictures[0].outline_rms, 1e-6);  // it starts at the truth
}

TEST(Estimate, AMissAboveTheNoiseIsNoSuccess) {
  // One stiffness alone cannot explain the outline of a fabric twice as stiff in the others.
  OutlineObservation seen = truth().seen;
  EstimateOptions options;
  options.parameters = {Parameter::k_bu};
  Fabric start = stiff_fabric();
  start.k_bv *= 2;
  start.k_bh *= 2;
  seen.noise = 1e-5;
  options.guide = {1};
  options.max_restarts = options.max_pops = 0;
  options.max_moves = 5;
  options.bound_factor = 1.5;
  const Estimate found = estimate({{truth().potential, kCusick, seen}}, start, options);
  EXPECT_GT(standing(found.outcome), standing(EstimateOutcome::succeeded)) << name(found.outcome);
  EXPECT_GT(found.pictures[0].outline_rms, 1.5 * seen.noise);
}

TEST(Estimate, AMissAboveTheNoiseWidensTheIntervals) {
  const auto log_sd = [](double noise) {
    OutlineObservation seen = truth().seen;
    seen.noise = noise;
    EstimateOptions options;
    options.parameters = {Parameter::k_bu};
    options.max_restarts = options.max_pops = 0;
    options.max_moves = 0;
    Fabric start = stiff_fabric();
    start.k_bv *= 1.3;  // held: no k_bu explains the outline
    const Picture picture{truth().potential, kCusick, seen, truth().equilibrium};
    const Estimate found = estimate({picture}, start, options);
    return std::pair(found.posterior.log_sd[0], found.pictures[0].outline_rms);
  };
  const auto [narrow, missed] = log_sd(1e-6);
  ASSERT_GT(missed, 1e-5);
  // the misfit stands for the noise, whatever was said of it, until the noise said is larger
  EXPECT_NEAR(log_sd(2e-6).first / narrow, 1, 0.01);
  EXPECT_NEAR(log_sd(4 * missed).first / narrow, 4, 0.2);
}

TEST(Estimate, OutcomesHaveNames) {
  EXPECT_EQ(name(EstimateOutcome::succeeded), "succeeded");
  EXPECT_EQ(name(EstimateOutcome::no_start), "no_start");
  EXPECT_EQ(name(EstimateOutcome::branch_lost), "branch_lost");
  EXPECT_EQ(name(EstimateOutcome::misfit), "misfit");
  EXPECT_EQ(name(EstimateOutcome::not_converged), "not_converged");
}

TEST(Estimate, RefusesBadInput) {
  const auto attempt = [](const OutlineObservation& seen, const EstimateOptions& options,
                          const std::optional<Equilibrium>& state = std::nullopt) {
    estimate({{truth().potential, kCusick, seen, state}}, truth().start(), options);
  };
  OutlineObservation seen = truth().seen;
  seen.profile.conservativeResize(kProfileSize - 1);
  EXPECT_THROW(attempt(seen, {}), std::invalid_argument);
  seen = truth().seen;
  seen.profile[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(attempt(seen, {}), std::invalid_argument);
  EstimateOptions nothing;
  nothing.parameters.clear();
  EXPECT_THROW(attempt(truth().seen, nothing), std::invalid_argument);
  Equilibrium stopped = truth().equilibrium;
  stopped.status = EquilibriumStatus::iteration_limit;
  EXPECT_THROW(attempt(truth().seen, {}, stopped), std::invalid_argument);
}

TEST(Estimate, SpentSolvesAreNoSuccess) {
  for (const FitMethod method : {FitMethod::levenberg_marquardt, FitMethod::bfgs}) {
    EstimateOptions options;
    options.method = method;
    options.max_solves = 5;
    const Estimate found = estimate({truth().picture()}, truth().start(), options);
    EXPECT_NE(found.outcome, EstimateOutcome::succeeded) << found.pictures[0].outline_rms;
    EXPECT_LT(found.forward_solves, 50);  // every guided start is laid, no neighbour is tried
  }
}

}  // namespace
}  // namespace drape::test
