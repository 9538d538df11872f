#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/contact.h"
#include "core/drape_protocol.h"
#include "tests/support/soft_drape.h"

namespace drape::test {
namespace {

constexpr double kHeld = 3e-4;  // no vertex of a drape is held deeper inside the support [m]

ContactDrape draped(Potential& potential, ContactMode mode,
                    const EquilibriumOptions& options = {}) {
  return drape_with_contact(
      potential, kCusick, mode,
      [&](const Potential& of) { return drape_by_lobes(of, kCusick, 6, 0.1, options); }, options);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Contact, ASoftFabricIsKeptOutOfTheSupport) {
  Potential potential(disc(400), soft_fabric(), {}, kCusick.gravity);
  const ContactDrape off = draped(potential, ContactMode::off);
  ASSERT_TRUE(off.equilibrium.converged());
  EXPECT_GT(off.contact.penetration, kAllowedPenetration);
  EXPECT_FALSE(potential.support());
  EXPECT_EQ(off.contact.acting(), "off");
  EXPECT_TRUE(would_choose_otherwise(potential, off.contact, off.equilibrium.x));

  const ContactDrape automatic = draped(potential, ContactMode::automatic);
  ASSERT_TRUE(automatic.equilibrium.converged());
  EXPECT_TRUE(potential.support());
  EXPECT_EQ(automatic.contact.acting(), "support");
  EXPECT_TRUE(contains(automatic.contact.reason, "without it the deepest vertex is"))
      << automatic.contact.reason;
  EXPECT_GT(automatic.contact.penetration, 0);
  EXPECT_LE(automatic.contact.penetration, kHeld);
  EXPECT_EQ(automatic.contact.self_intersections, 0);
  EXPECT_EQ(automatic.equilibrium.protocol, off.equilibrium.protocol);
  EXPECT_GT(automatic.equilibrium.newton_iterations, off.equilibrium.newton_iterations);
  EXPECT_FALSE(would_choose_otherwise(potential, automatic.contact, automatic.equilibrium.x));
  // the potential left behind is the one whose equilibrium this is, and the support carries cloth
  const VecX& x = automatic.equilibrium.x;
  EXPECT_LE(potential.residual(potential.gradient(x)), 1e-8);
  EXPECT_GT(potential.contact_force(x).norm(), potential.largest_nodal_weight());
}

TEST(Contact, AFabricThatDoesNotTouchIsBitEqualWithAndWithout) {
  Potential potential(disc(400), medium_fabric(), {}, kCusick.gravity);
  const ContactDrape off = draped(potential, ContactMode::off);
  const ContactDrape automatic = draped(potential, ContactMode::automatic);
  ASSERT_TRUE(off.equilibrium.converged());
  EXPECT_EQ(automatic.equilibrium.x, off.equilibrium.x);
  EXPECT_FALSE(automatic.contact.support);
  EXPECT_EQ(automatic.contact.penetration, 0);
  EXPECT_TRUE(contains(automatic.contact.reason, "Not needed: no vertex is in the support"));
  // with the support in the potential, outside of which every iterate stays
  const ContactDrape on = draped(potential, ContactMode::support);
  EXPECT_EQ(on.equilibrium.x, off.equilibrium.x);
  EXPECT_TRUE(on.contact.support);
  EXPECT_TRUE(would_choose_otherwise(potential, on.contact, on.equilibrium.x));
}

TEST(Contact, DensityAndAllStiffnessesTogetherLeaveTheShape) {
  Potential light(disc(400), soft_fabric(), {}, kCusick.gravity);
  const ContactDrape first = draped(light, ContactMode::automatic, {.tolerance = 1e-10});
  Fabric heavy = soft_fabric();
  for (const Parameter p : {Parameter::areal_density, Parameter::k_u, Parameter::k_v,
                            Parameter::k_h, Parameter::k_bu, Parameter::k_bv, Parameter::k_bh})
    heavy[p] *= 3;
  Potential scaled = light;
  scaled.set_fabric(heavy);
  const Equilibrium second = solve_equilibrium(scaled, first.equilibrium.x, {.tolerance = 1e-10});
  ASSERT_TRUE(first.equilibrium.converged() && second.converged());
  EXPECT_LE((second.x - first.equilibrium.x).cwiseAbs().maxCoeff(), 1e-9);  // solver tolerance
}

TEST(Contact, AFailedDrapeIsNotChecked) {
  Potential potential(disc(300), soft_fabric(), {}, kCusick.gravity);
  const ContactDrape failed = draped(potential, ContactMode::automatic, {.max_iterations = 2});
  EXPECT_FALSE(failed.equilibrium.converged());
  EXPECT_FALSE(failed.contact.checked);
  EXPECT_TRUE(contains(failed.contact.reason, "did not converge")) << failed.contact.reason;
}

TEST(Contact, CountsSelfIntersections) {
  const Potential potential(disc(300), medium_fabric(), {}, kCusick.gravity);
  VecX x = flat_state(potential.mesh());
  EXPECT_EQ(check_contact(potential, kCusick, x).self_intersections, 0);
  for (int v = 0; v < potential.mesh().vertex_count(); ++v) {
    const double u = potential.mesh().rest_uv(v, 0) / 0.15;  // a loop that crosses itself
    x[3 * v] = 0.1 * u * u;
    x[3 * v + 2] = 0.1 * (u * u * u - 0.5 * u);
  }
  EXPECT_GT(check_contact(potential, kCusick, x).self_intersections, 0);
}

}  // namespace
}  // namespace drape::test
