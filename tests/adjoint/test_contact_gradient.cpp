// Gradients of a drape that rests against the support: contact enters through the Hessian alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/adjoint.h"
#include "adjoint/loss.h"
#include "adjoint/sensitivity.h"
#include "core/contact.h"
#include "core/drape_protocol.h"
#include "tests/support/soft_drape.h"

namespace drape::test {
namespace {

Loss loss_at(const VecX& x, const Mesh& mesh) {
  VecX radius(kProfileSize);
  for (int i = 0; i < kProfileSize; ++i)
    radius[i] = 0.115 + 0.008 * std::cos(5 * 2 * M_PI * i / kProfileSize + 0.4);
  return profile_loss(trace_outline(mesh, kCusick, x), radius);
}

TEST(ContactGradient, AllParametersAgainstReSolvedEquilibria) {
  constexpr BendingReading kReading{BendingLaw::tangent, BendingThreshold::radius};
  const EquilibriumOptions tight{.tolerance = 1e-12};  // ends at the rounding floor
  Potential potential(disc(300), soft_fabric(), kReading, kCusick.gravity);
  const ContactDrape drape = drape_with_contact(
      potential, kCusick, ContactMode::automatic,
      [&](const Potential& of) { return drape_by_lobes(of, kCusick, 6, 0.1, tight); }, tight);
  const Equilibrium& at = drape.equilibrium;
  ASSERT_TRUE(at.converged());
  ASSERT_TRUE(drape.contact.support);
  ASSERT_GT(potential.contact_force(at.x).norm(), potential.largest_nodal_weight());
  ASSERT_GT(potential.wings_past_threshold(at.x), 0);

  const Mesh& mesh = potential.mesh();
  const Outline outline = trace_outline(mesh, kCusick, at.x);
  const VecX dL_dx = pull_back(outline, at.x, loss_at(at.x, mesh).dL_dpoints);
  const ParameterVector dL_dp = adjoint_gradient(potential, at, dL_dx);

  // the tangent is another route to the same number
  const std::vector<Parameter> all(all_parameters().begin(), all_parameters().end());
  const VecX by_tangent = sensitivities(potential, at, all).transpose() * dL_dx;
  const VecX share = to_vector(potential.fabric());
  EXPECT_LE((by_tangent - dL_dp).cwiseProduct(share).norm(),
            1e-9 * dL_dp.cwiseProduct(share).norm());

  const std::vector<bool> regimes = potential.wing_regimes(at.x);
  VecX adjoint(kParameterCount), difference(kParameterCount);
  for (const Parameter p : all) {
    const int j = static_cast<int>(p);
    const bool linear =
        p == Parameter::t_bu || p == Parameter::t_bv || p == Parameter::t_bh;  // else logarithm
    const double scale = linear ? 1 : potential.fabric()[p];
    adjoint[j] = scale * dL_dp[j];
    difference[j] = std::nan("");
    for (const double step : {3e-5, 1e-4, 1e-5, 1e-3, 3e-6, 1e-6}) {
      double value[2];
      bool smooth = true;
      for (int side = 0; side < 2; ++side) {
        const double signed_step = side == 0 ? step : -step;
        Fabric fabric = potential.fabric();
        fabric[p] = linear ? fabric[p] + signed_step : fabric[p] * std::exp(signed_step);
        Potential other = potential;
        other.set_fabric(fabric);
        const Equilibrium solved = solve_equilibrium(other, at.x, tight);
        ASSERT_TRUE(solved.converged());
        smooth &= other.wing_regimes(solved.x) == regimes;
        value[side] = loss_at(solved.x, mesh).value;
      }
      const double f = (value[0] - value[1]) / (2 * step);
      if (smooth && !(std::abs(f - adjoint[j]) >= std::abs(difference[j] - adjoint[j])))
        difference[j] = f;
      if (std::abs(f - adjoint[j]) < 1e-7 * std::abs(f)) break;  // no need of a better step
    }
    ASSERT_FALSE(std::isnan(difference[j])) << name(p) << ": a wing switches at every step";
  }
  const double largest = difference.cwiseAbs().maxCoeff();
  for (const Parameter p : all) {
    const int j = static_cast<int>(p);
    EXPECT_LE(
        std::abs(adjoint[j] - difference[j]) / std::max(std::abs(difference[j]), 1e-4 * largest),
        1e-6)
        << name(p) << ": adjoint " << adjoint[j] << ", difference " << difference[j];
  }
}

}  // namespace
}  // namespace drape::test
