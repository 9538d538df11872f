#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "adjoint/fold.h"
#include "core/drape_protocol.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

const std::vector<Parameter> kBending{Parameter::k_bu, Parameter::k_bv, Parameter::k_bh};

TEST(Branch, AScaledPathAndItsRate) {
  const FabricPath path = scaled_path(medium_fabric(), kBending);
  EXPECT_NEAR(path.fabric(0.3).k_bv, medium_fabric().k_bv * std::exp(0.3), 1e-20);
  EXPECT_EQ(path.fabric(0.3).k_h, medium_fabric().k_h);
  const ParameterVector difference =
      (to_vector(path.fabric(0.3 + 1e-5)) - to_vector(path.fabric(0.3 - 1e-5))) / 2e-5;
  EXPECT_LE((difference - path.dp_ds(0.3)).cwiseAbs().maxCoeff(), 1e-13);  // h^2 k_b + eps k/h
}

TEST(Branch, ThereAndBackAgainWithoutASnap) {
  const FabricPath path = scaled_path(stiff_fabric(), kBending);
  Potential potential(disc(300), stiff_fabric(), {}, kCusick.gravity);
  const Equilibrium drape = drape_by_lobes(potential, kCusick, 3, 0, {.tolerance = 1e-11});
  ASSERT_TRUE(drape.converged());
  BranchState state = make_branch_state(potential, path, 0, drape);
  const BranchOptions options{.equilibrium = {.tolerance = 1e-11}};
  ContinuationCost cost;
  int points = 0, snaps = 0;
  const SweepVisitor visitor{[&](const BranchState&) { return ++points > 0; },
                             [&](const Snap&) { ++snaps; }};
  ASSERT_TRUE(sweep(potential, path, 0.3, options, state, cost, visitor));
  EXPECT_EQ(state.s, 0.3);
  EXPECT_GE(points, 6);
  EXPECT_GT(largest_distance(state.equilibrium.x, drape.x), 1e-4);
  ASSERT_TRUE(sweep(potential, path, 0, options, state, cost, visitor));
  EXPECT_EQ(snaps, 0);
  // a residual of 1e-11 over the smallest eigenvalue; another branch is millimetres away
  EXPECT_LE(largest_distance(state.equilibrium.x, drape.x), 1e-6);
}

TEST(Branch, AVisitorStopsASweep) {
  const FabricPath path = scaled_path(stiff_fabric(), kBending);
  Potential potential(disc(250), stiff_fabric(), {}, kCusick.gravity);
  BranchState state =
      make_branch_state(potential, path, 0, drape_by_lobes(potential, kCusick, 4, 0.1));
  ContinuationCost cost;
  EXPECT_FALSE(
      sweep(potential, path, 0.3, {}, state, cost, {[](const BranchState&) { return false; }, {}}));
  EXPECT_EQ(cost.solves, 1);
  EXPECT_NEAR(state.s, BranchOptions{}.largest_step, 1e-15);
}

/// A strip between two clamps that are nearer than it is long, buckled upwards: an arch. One clamp
/// lies lower, so that no symmetry turns the fold into a bifurcation.
class Arch : public testing::Test {
 protected:
  static constexpr double kLength = 0.1, kNearer = 0.98, kRise = 9e-3, kLower = 2e-3;

  Arch() {
    Mesh open = strip(kLength, 0.02, 2);
    const double end = open.rest_uv.col(0).maxCoeff();
    std::vector<std::uint8_t> fixed = open.fixed;
    for (size_t i = 0; i < fixed.size(); ++i)
      if (open.rest_uv(static_cast<Eigen::Index>(i), 0) > 0.88 * end) fixed[i] = 1;
    discretization = std::make_shared<const Discretization>(
        make_mesh(open.rest_uv, open.triangles, std::move(fixed)));
    x = flat_state(discretization->mesh());
    const double inner = 0.88 * end;
    for (int v = 0; v < discretization->mesh().vertex_count(); ++v) {
      const double u = std::clamp(discretization->mesh().rest_uv(v, 0) / inner, 0.0, 1.0);
      x[3 * v] -= (1 - kNearer) * inner * u;
      x[3 * v + 2] = kRise / 2 * (1 - std::cos(2 * std::numbers::pi * u)) - kLower * u;
    }
  }

  std::shared_ptr<const Discretization> discretization;
  VecX x;
};

TEST_F(Arch, SnapsThroughAtALimitPoint) {
  Fabric fabric;
  fabric.areal_density = 0.003;
  const FabricPath path = scaled_path(fabric, {Parameter::areal_density});
  Potential potential(discretization, fabric, {}, kCusick.gravity);
  const Equilibrium up = solve_equilibrium(potential, x);
  ASSERT_TRUE(up.converged()) << name(up.status);
  ASSERT_GT(up.x(Eigen::seq(2, Eigen::last, 3)).maxCoeff(), kRise / 2);
  BranchState state = make_branch_state(potential, path, 0, up);
  ContinuationCost cost;
  std::vector<Snap> snaps;
  const SweepVisitor visitor{{}, [&](const Snap& snap) { snaps.push_back(snap); }};
  const double heavy = std::log(100.0);
  ASSERT_TRUE(sweep(potential, path, heavy, {}, state, cost, visitor));
  EXPECT_LT(state.equilibrium.x(Eigen::seq(2, Eigen::last, 3)).minCoeff(), -kRise / 2);
  ASSERT_EQ(snaps.size(), 1u);
  const Snap& snap = snaps.front();
  EXPECT_EQ(snap.fold.end, BranchEnd::limit_point);
  EXPECT_EQ(snap.fold.negative_eigenvalues, 1);
  EXPECT_GT(snap.s, snap.fold.s);
  EXPECT_GT(snap.vertex_jump, kRise);
  EXPECT_GT(snap.energy_drop, 0);

  // At the fold dg/ds has no share in the range of H: H v = 0 along the curve, ds = 0.
  potential.set_fabric(path.fabric(snap.fold.s));
  SparseMatrix H;
  potential.hessian(snap.fold.x, 0, H);
  const VecX v = discretization->to_free(snap.fold.onward).normalized();
  const double along = v.dot(H.selfadjointView<Eigen::Lower>() * v);
  // 1e-3 of the stiffness of the strip's softest mode, which is B (2 pi / L)^4 A per vertex
  EXPECT_LE(std::abs(along), 1e-3 * H.diagonal().minCoeff());

  // Hysteresis: back to where it began the arch hangs still, for gravity is not needed there.
  const size_t before = snaps.size();
  ASSERT_TRUE(sweep(potential, path, 0, {}, state, cost, visitor));
  EXPECT_EQ(snaps.size(), before);
  EXPECT_GT(largest_distance(state.equilibrium.x, up.x), kRise);
}

TEST_F(Arch, AFoldIsWhereNaturalStepsEnd) {
  Fabric fabric;
  fabric.areal_density = 0.003;
  const FabricPath path = scaled_path(fabric, {Parameter::areal_density});
  Potential potential(discretization, fabric, {}, kCusick.gravity);
  BranchState state = make_branch_state(potential, path, 0, solve_equilibrium(potential, x));
  ContinuationCost cost;
  const BranchOptions options;
  ASSERT_FALSE(follow_minima(potential, path, std::log(100.0), options, state, cost));
  const Fold fold = trace_fold(potential, path, state, 1, options, cost);
  EXPECT_EQ(fold.end, BranchEnd::limit_point);
  EXPECT_GE(fold.s, state.s);
  EXPECT_LE(fold.s, state.s + 4 * options.smallest_step);
  // the step does not decide where it is
  BranchOptions finer;
  finer.smallest_step = options.smallest_step / 3;
  const Fold again = trace_fold(potential, path, state, 1, finer, cost);
  EXPECT_NEAR(again.s, fold.s, 1e-6);
}

TEST_F(Arch, AStepThatSnapsIsGivenUpOnTheWay) {
  Fabric fabric;
  fabric.areal_density = 0.003;
  const double heavy = std::log(100.0);
  const FabricPath path = scaled_path(fabric, {Parameter::areal_density});
  Potential potential(discretization, fabric, {}, kCusick.gravity);
  const BranchState start = make_branch_state(potential, path, 0, solve_equilibrium(potential, x));
  int seen = 0;
  BranchOptions options;
  options.largest_step = options.smallest_step = heavy;
  options.equilibrium.go_on = [&](const VecX&, const VecX&) { return ++seen > 0; };
  BranchState state = start;
  ContinuationCost cost;
  ASSERT_FALSE(follow_minima(potential, path, heavy, options, state, cost));
  EXPECT_EQ(state.s, 0);
  EXPECT_EQ(cost.solves, 1);
  EXPECT_GT(seen, 0);

  // the same solve to its end, which is the arch that hangs
  const Equilibrium hanging = solve_equilibrium(
      potential, start.equilibrium.x + heavy * start.dx_ds, {}, start.equilibrium.factor);
  ASSERT_TRUE(hanging.converged());
  EXPECT_GT(largest_distance(hanging.x, start.equilibrium.x), kRise);
  EXPECT_LT(2 * cost.newton_iterations, hanging.newton_iterations);
}

}  // namespace
}  // namespace drape::test
