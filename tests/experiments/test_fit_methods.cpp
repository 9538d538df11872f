// The fits that kind = "estimation_precision" compares, on one small drape.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/drape_protocol.h"
#include "experiments/fit_methods.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

const std::vector<Parameter> kParameters{Parameter::k_bu, Parameter::k_bh};

/// The outline of a stiff fabric and the drape of one a little stiffer on the same branch.
struct Case {
  Case() : space{kParameters, stiff_fabric()} {
    Potential potential(disc(250), stiff_fabric(), {}, kCusick.gravity);
    const Equilibrium target = drape_by_lobes(potential, kCusick, 4, 0.1, {.tolerance = 1e-10});
    for (const Parameter p : kParameters) space.reference[p] *= 1.1;
    picture = Picture{potential, kCusick, {}};
    picture->seen.profile =
        radial_profile(trace_outline(potential.mesh(), kCusick, target.x).points).radius;
    potential.set_fabric(space.reference);
    picture->start_state = solve_equilibrium(potential, target.x);
  }

  DrapeObjective objective() const {
    DrapeObjective made({*picture}, space, std::nullopt, {}, 1000);
    Potential potential = picture->model;
    potential.set_fabric(space.reference);
    made.start_from(0, potential,
                    make_branch_point(potential, space, start(), *picture->start_state), {});
    return made;
  }
  VecX start() const { return space.encode(space.reference); }
  VecX truth() const { return space.encode(stiff_fabric()); }

  ParameterSpace space;
  std::optional<Picture> picture;
};

const Case& small() {
  static const Case c;
  return c;
}

TEST(FitMethods, AllFindTheTruthAndTheirTracesOnlyImprove) {
  ASSERT_TRUE(small().picture->start_state->converged());
  for (const FitMethodInfo& method : compared_fits({})) {
    SCOPED_TRACE(method.name);
    const TracedFit fit = traced_fit(method.method, *small().picture, small().space, {});
    ASSERT_GE(fit.moments.size(), 2);
    EXPECT_EQ(fit.moments.front().z, small().start());
    for (size_t i = 1; i < fit.moments.size(); ++i) {
      EXPECT_LT(fit.moments[i].cost, fit.moments[i - 1].cost);
      EXPECT_GE(fit.moments[i].cpu_seconds, fit.moments[i - 1].cpu_seconds);
      EXPECT_GE(fit.moments[i].forward_solves, fit.moments[i - 1].forward_solves);
    }
    // a hundredth of the distance of the start; the coarsest stop is that of steps below 1e-6
    EXPECT_LE((fit.moments.back().z - small().truth()).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST(FitMethods, DifferencesAreNearTheExactDerivatives) {
  DrapeObjective exact = small().objective();
  DifferencedObjective differenced(exact, 1e-10);
  VecX r, r_again, gradient, gradient_again;
  MatX J, J_again;
  double cost, cost_again;
  ASSERT_TRUE(exact.residuals_at(small().start(), r, &J));
  ASSERT_TRUE(differenced.residuals_at(small().start(), r_again, &J_again));
  EXPECT_EQ(r, r_again);
  EXPECT_LE((J_again - J).norm(), 1e-3 * J.norm());  // forward differences: in proportion to steps
  EXPECT_EQ(differenced.solves(), 2);
  ASSERT_TRUE(exact.cost_at(small().start(), cost, &gradient));
  ASSERT_TRUE(differenced.cost_at(small().start(), cost_again, &gradient_again));
  EXPECT_EQ(cost, cost_again);
  EXPECT_LE((gradient_again - gradient).norm(), 1e-4 * gradient.norm());  // to their square
  EXPECT_EQ(differenced.solves(), 6);
}

TEST(FitMethods, StopWhenTheirTimeIsSpent) {
  const TracedFit fit =
      traced_fit(ComparedFit::nelder_mead, *small().picture, small().space, {.cpu_seconds = 1e-9});
  EXPECT_FALSE(fit.converged);
  EXPECT_LE(fit.moments.size(), 1);
}

TEST(FitMethods, RefuseWhatTheyCannotFit) {
  Picture without_start = *small().picture;
  without_start.start_state.reset();
  EXPECT_THROW(traced_fit(ComparedFit::bfgs, without_start, small().space, {}),
               std::invalid_argument);
  EXPECT_THROW(
      traced_fit(ComparedFit::bfgs, *small().picture, {{Parameter::t_bu}, stiff_fabric()}, {}),
      std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
