// The gradient through unrolled dynamics: exact for the motion, and the drape's in the long run.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/adjoint.h"
#include "benchmarks/baselines/unrolled_dynamics.h"
#include "core/equilibrium.h"
#include "tests/support/solved_drape.h"

namespace drape::baselines {
namespace {

/// A functional of the state with entries of all sizes: the height of every vertex, weighed.
VecX weights(const Potential& potential) {
  VecX w = VecX::Zero(3 * potential.mesh().vertex_count());
  for (int v = 0; v < potential.mesh().vertex_count(); ++v) w[3 * v + 2] = std::sin(1.0 + v);
  return w;
}

/// A drape, to be pushed by another fabric.
const test::SolvedDrape& solved() {
  static const test::SolvedDrape drape;
  return drape;
}

Potential pushed(double factor) {
  Potential potential = solved().potential;
  Fabric fabric = potential.fabric();
  for (Parameter k : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh}) fabric[k] *= factor;
  potential.set_fabric(fabric);
  return potential;
}

TEST(UnrolledDynamics, GradientIsThatOfTheMotion) {
  const Potential potential = pushed(1.1);
  const VecX w = weights(potential);
  const auto value = [&](const Fabric& fabric) {
    Potential other = potential;
    other.set_fabric(fabric);
    UnrolledDynamics motion(other, solved().equilibrium.x, 0.01);
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(motion.advance());
    return w.dot(motion.state());
  };
  UnrolledDynamics motion(potential, solved().equilibrium.x, 0.01);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(motion.advance());
  EXPECT_EQ(motion.steps(), 4);
  const ParameterVector gradient = motion.gradient(w);
  for (Parameter p : {Parameter::areal_density, Parameter::k_h, Parameter::k_bu, Parameter::k_bh}) {
    const double step = 1e-4 * potential.fabric()[p];
    Fabric more = potential.fabric(), less = more;
    more[p] += step;
    less[p] -= step;
    const double difference = (value(more) - value(less)) / (2 * step);
    // steps solved to 1e-9 of a nodal weight, differenced over 1e-4
    EXPECT_NEAR(gradient[static_cast<int>(p)], difference, 2e-4 * std::abs(difference)) << name(p);
  }
}

TEST(UnrolledDynamics, LongStepsEndAtTheGradientOfTheDrape) {
  const Potential potential = pushed(1.02);
  const Equilibrium rest =
      solve_equilibrium(potential, solved().equilibrium.x, {.tolerance = 1e-10});
  ASSERT_TRUE(rest.converged());
  const VecX w = weights(potential);
  const double wanted = adjoint_gradient(potential, rest, w)[static_cast<int>(Parameter::k_bh)];
  UnrolledDynamics motion(potential, solved().equilibrium.x, 1);
  double before = 0;
  for (const int steps : {2, 12}) {
    while (motion.steps() < steps) ASSERT_TRUE(motion.advance());
    const double error =
        std::abs(motion.gradient(w)[static_cast<int>(Parameter::k_bh)] / wanted - 1);
    if (steps == 12) {
      EXPECT_LT(error, 0.1 * before);
      EXPECT_LT(error, 0.05);  // the slowest mode is still damping out
    }
    before = error;
  }
}

}  // namespace
}  // namespace drape::baselines
