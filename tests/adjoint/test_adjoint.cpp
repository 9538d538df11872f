#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/adjoint.h"
#include "adjoint/loss.h"
#include "tests/support/derivative_check.h"
#include "tests/support/solved_drape.h"

namespace drape::test {
namespace {

const SolvedDrape& drape() {
  static const SolvedDrape solved;
  return solved;
}

using LossOf = std::function<Loss(const Outline&)>;

/// The three losses, with a smaller disc with five folds as the observation.
std::vector<std::pair<std::string, LossOf>> losses() {
  VecX radius(kProfileSize);
  Points2 polygon(kProfileSize, 2);
  for (int i = 0; i < kProfileSize; ++i) {
    const double alpha = 2 * M_PI * i / kProfileSize;
    radius[i] = 0.115 + 0.008 * std::cos(5 * alpha + 0.4);
    polygon.row(i) = radius[i] * Vec2(std::cos(alpha), std::sin(alpha));
  }
  const PixelGrid grid = centred_grid(64, 0.32);
  const CoverageImage image = coverage(polygon, grid);
  return {
      {"profile", [=](const Outline& o) { return profile_loss(o, radius); }},
      {"coverage", [=](const Outline& o) { return coverage_loss(o, grid, image); }},
      {"drape coefficient", [](const Outline& o) { return drape_coefficient_loss(o, kCusick); }}};
}

VecX dL_dx(const SolvedDrape& d, const LossOf& loss) {
  return pull_back(d.outline, d.equilibrium.x, loss(d.outline).dL_dpoints);
}

TEST(Adjoint, AgainstDifferencesOfReSolvedEquilibria) {
  const SolvedDrape& d = drape();
  ASSERT_GT(d.potential.wings_past_threshold(d.equilibrium.x), 0);
  const Fabric fabric = d.potential.fabric();
  Random random(1);
  for (int trial = 0; trial < 3; ++trial) {
    const ParameterVector direction = random_vector(kParameterCount, random);
    // a wing that crosses its threshold changes the slope: the best of three steps
    std::map<std::string, double> best;
    for (const double step : {1e-4, 3e-5, 1e-5}) {
      const Equilibrium forward = d.solve(scaled(fabric, direction, step));
      const Equilibrium backward = d.solve(scaled(fabric, direction, -step));
      ASSERT_TRUE(forward.converged());
      ASSERT_TRUE(backward.converged());
      for (const auto& [name, loss] : losses()) {
        const auto value = [&, &loss = loss](const VecX& x) {
          return loss(trace_outline(d.potential.mesh(), kCusick, x)).value;
        };
        const double difference = (value(forward.x) - value(backward.x)) / (2 * step);
        const ParameterVector per_share =
            adjoint_gradient(d.potential, d.equilibrium, dL_dx(d, loss))
                .cwiseProduct(to_vector(fabric));
        const double error = std::abs(per_share.dot(direction) - difference) / per_share.norm();
        const auto [entry, first] = best.emplace(name, error);
        if (!first) entry->second = std::min(entry->second, error);
      }
    }
    for (const auto& [name, error] : best)  // residual 1e-11 over the step, and step^2
      EXPECT_LE(error, 1e-6) << name << ", direction " << trial;
  }
}

TEST(Adjoint, AGuideIsPartOfTheEquilibrium) {
  const SolvedDrape& d = drape();
  VecX radius(kProfileSize);
  for (int i = 0; i < kProfileSize; ++i)
    radius[i] = 0.12 + 0.01 * std::cos(5 * 2 * M_PI * i / kProfileSize);
  Potential guided = d.potential;
  guided.set_guide(Guide{harmonics(radius, 12), Vec2::Zero(), 0.01});
  const EquilibriumOptions tight{.tolerance = 1e-11};
  const Equilibrium at = solve_equilibrium(guided, d.equilibrium.x, tight);
  ASSERT_TRUE(at.converged());
  const Points2 dA = area_gradient(trace_outline(guided.mesh(), kCusick, at.x).points);
  const VecX dA_dx = pull_back(trace_outline(guided.mesh(), kCusick, at.x), at.x, dA);
  const ParameterVector gradient = adjoint_gradient(guided, at, dA_dx);
  for (const Parameter p : {Parameter::areal_density, Parameter::k_bu, Parameter::k_h}) {
    double best = 1;
    for (const double step : {1e-4, 1e-5}) {
      double value[2];
      for (int side = 0; side < 2; ++side) {
        Fabric fabric = d.potential.fabric();
        fabric[p] *= side == 0 ? 1 + step : 1 - step;
        Potential other = guided;
        other.set_fabric(fabric);
        const Equilibrium solved = solve_equilibrium(other, at.x, tight);
        ASSERT_TRUE(solved.converged());
        value[side] = area(trace_outline(guided.mesh(), kCusick, solved.x).points);
      }
      const double per_share = gradient[static_cast<int>(p)] * d.potential.fabric()[p];
      const double difference = (value[0] - value[1]) / (2 * step);
      best = std::min(best, std::abs(difference - per_share) / std::abs(per_share));
    }
    EXPECT_LE(best, 1e-5) << name(p);  // one entry alone, relative to itself
  }
}

TEST(Adjoint, HalvingTheToleranceChangesNothing) {
  const SolvedDrape coarse(1e-8), fine(5e-9);
  for (const auto& [name, loss] : losses()) {
    const ParameterVector a =
        adjoint_gradient(coarse.potential, coarse.equilibrium, dL_dx(coarse, loss));
    const ParameterVector b = adjoint_gradient(fine.potential, fine.equilibrium, dL_dx(fine, loss));
    const ParameterVector p = to_vector(fine.potential.fabric());
    // the gradient's own derivative times a residual of 1e-8
    EXPECT_LE((a - b).cwiseProduct(p).norm(), 1e-6 * b.cwiseProduct(p).norm()) << name;
  }
}

TEST(Adjoint, RefusesWhatIsNoConvergedMinimum) {
  const SolvedDrape& d = drape();
  const VecX zero = VecX::Zero(d.equilibrium.x.size());
  const VecX start = folded_state(d.potential.mesh(), kCusick, 5, 0);
  const Equilibrium stopped = solve_equilibrium(d.potential, start, {.max_iterations = 1});
  EXPECT_THROW(adjoint_gradient(d.potential, stopped, zero), std::invalid_argument);
  const Equilibrium uncertified =
      solve_equilibrium(d.potential, d.equilibrium.x, {.certify = false});
  ASSERT_TRUE(uncertified.converged());
  EXPECT_THROW(adjoint_gradient(d.potential, uncertified, zero), std::invalid_argument);
  const Potential other(disc(250), medium_fabric(), {}, kCusick.gravity);
  EXPECT_THROW(adjoint_gradient(other, d.equilibrium, zero), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
