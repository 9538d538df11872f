// Where a solve is hard: each case has one handling and one status.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/drape_protocol.h"
#include "core/equilibrium.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

constexpr double kGravity = 9.80665;

Potential potential(std::shared_ptr<const Discretization> d, const Fabric& fabric) {
  return Potential(std::move(d), fabric, {}, kGravity);
}

const std::shared_ptr<const Discretization>& small_disc() {
  static const std::shared_ptr<const Discretization> d = disc(300);
  return d;
}

/// A flat strip that is clamped at both ends: Euler's column once it is compressed.
const std::shared_ptr<const Discretization>& column() {
  static const std::shared_ptr<const Discretization> d = [] {
    const Mesh mesh = strip(0.06, 0.01, 2);
    std::vector<std::uint8_t> fixed = mesh.fixed;
    const double end = mesh.rest_uv.col(0).maxCoeff();
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.rest_uv(v, 0) > end - 1e-9) fixed[static_cast<size_t>(v)] = 1;
    return std::make_shared<const Discretization>(make_mesh(mesh.rest_uv, mesh.triangles, fixed));
  }();
  return d;
}

VecX compressed_column(double shortening) {
  VecX x = flat_state(column()->mesh());
  for (int v = 0; v < column()->mesh().vertex_count(); ++v)
    if (x[3 * v] > 0) x[3 * v] *= 1 - shortening;
  return x;
}

TEST(HardEquilibrium, LeavesASaddle) {
  const VecX x = compressed_column(0.02);
  const Potential E(column(), stiff_fabric(), {}, 1e-9);  // weight sets the scale of residuals only
  SparseMatrix H;
  E.hessian(x, 0, H);
  ASSERT_GT(negative_eigenvalues(H), 0);
  const Equilibrium buckled = solve_equilibrium(E, x, {.tolerance = 1e3});
  ASSERT_TRUE(buckled.converged()) << name(buckled.status);
  EXPECT_EQ(buckled.negative_eigenvalues, 0);
  EXPECT_LT(buckled.energy, E.energy(x));
  double rise = 0;
  for (int v = 0; v < column()->mesh().vertex_count(); ++v)
    rise = std::max(rise, std::abs(buckled.x[3 * v + 2]));
  // inextensible clamped column: end shortening (pi rise / length)^2 / 4 = 0.02
  const double length = column()->mesh().rest_uv.col(0).maxCoeff();
  EXPECT_NEAR(rise, 2 * std::sqrt(0.02) / M_PI * length, 0.1 * rise);
}

TEST(HardEquilibrium, ReportsASaddleWithoutAWayDown) {
  // At the very load of buckling the energy along the buckling mode differs by rounding only. Any
  // residual is allowed here, so that the solver has nothing to do but to certify or leave.
  const Potential E(column(), stiff_fabric(), {}, 1e-20);
  const EquilibriumOptions any_residual{.tolerance = 1e300};
  SparseFactor factor(column()->symbolic_factor());
  SparseMatrix H;
  double stable = 0, unstable = 0.02;
  for (int i = 0; i < 60; ++i) {
    const double shortening = (stable + unstable) / 2;
    E.hessian(compressed_column(shortening), 0, H);
    (factor.factorize(H) ? stable : unstable) = shortening;
  }
  ASSERT_GT(stable, 0);
  ASSERT_LT(unstable, 0.02);
  const VecX x = compressed_column(unstable);
  const Equilibrium at_buckling = solve_equilibrium(E, x, any_residual);
  EXPECT_EQ(at_buckling.status, EquilibriumStatus::saddle) << name(at_buckling.status);
  EXPECT_EQ(at_buckling.x, x);
  EXPECT_NE(at_buckling.negative_eigenvalues, 0);
  EXPECT_EQ(at_buckling.factor, nullptr);
  EXPECT_THROW(smallest_eigenvalue(at_buckling), std::invalid_argument);
  // a little less is certified where it is, from a little more there is a way down
  const VecX less = compressed_column(0.99 * unstable), more = compressed_column(1.01 * unstable);
  EXPECT_EQ(solve_equilibrium(E, less, any_residual).x, less);
  EXPECT_TRUE(solve_equilibrium(E, less, any_residual).converged());
  EXPECT_LT(solve_equilibrium(E, more, any_residual).energy, E.energy(more));
}

TEST(HardEquilibrium, TheSymmetricFlatDiscFindsAMinimum) {
  const Potential E = potential(small_disc(), medium_fabric());
  const VecX flat = flat_state(small_disc()->mesh());
  const Equilibrium drape = solve_equilibrium(E, flat);
  ASSERT_TRUE(drape.converged()) << name(drape.status) << " " << drape.residual;
  EXPECT_EQ(drape.negative_eigenvalues, 0);
  EXPECT_LT(drape.energy, 0);  // gravity's work exceeds the strain energy
}

TEST(HardEquilibrium, ATolerancePastTheRoundingFloorEndsAtTheFloor) {
  for (const Fabric& fabric : {stiff_fabric(), medium_fabric()})
    for (const double tolerance : {0.0, 1e-30}) {
      const Potential E = potential(small_disc(), fabric);
      const Equilibrium drape = drape_by_lobes(E, kCusick, 4, 0, {.tolerance = tolerance});
      ASSERT_TRUE(drape.converged()) << name(drape.status) << ", residual " << drape.residual;
      EXPECT_EQ(drape.rounding_floor, E.rounding_floor(drape.x));
      EXPECT_GT(drape.rounding_floor, 0);
      EXPECT_LE(drape.residual, drape.rounding_floor);
      EXPECT_LT(drape.rounding_floor, 1e-8);
      EXPECT_EQ(drape.negative_eigenvalues, 0);
    }
}

TEST(HardEquilibrium, StiffnessesManyOrdersApartConverge) {
  const Mesh& mesh = small_disc()->mesh();
  double area = 0;
  for (const RestTriangle& triangle : mesh.rest) area += triangle.area;
  const double h2 = 4 / std::sqrt(3.0) * area / mesh.triangle_count();  // mean edge squared

  Fabric in_plane_over_bending = stiff_fabric();
  for (const Parameter k : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh})
    in_plane_over_bending[k] = 1e-8;
  for (const Parameter k : {Parameter::k_u, Parameter::k_v, Parameter::k_h})
    in_plane_over_bending[k] = 1e8 * 1e-8 / h2;
  Fabric stiffer = in_plane_over_bending;  // its floor lies above the tolerance
  for (const Parameter k : {Parameter::k_u, Parameter::k_v, Parameter::k_h}) stiffer[k] *= 1e2;
  Fabric stretch_over_shear = medium_fabric();
  stretch_over_shear.k_h = 1;
  stretch_over_shear.k_u = stretch_over_shear.k_v = 1e6;

  for (const Fabric& fabric : {in_plane_over_bending, stiffer, stretch_over_shear}) {
    const Potential E = potential(small_disc(), fabric);
    const Equilibrium drape = drape_by_coarse_ramp(E, 1);
    ASSERT_TRUE(drape.converged()) << name(drape.status) << ", residual " << drape.residual;
    EXPECT_LE(drape.residual, std::max(1e-8, E.rounding_floor(drape.x)));
    EXPECT_EQ(drape.negative_eigenvalues, 0);
    EXPECT_LT(drape.energy, 0);
  }
}

/// A vertex that hangs on a clamped edge. Radius reading: the wing is past its threshold from an
/// angle on that falls with k_b.
const std::shared_ptr<const Discretization>& hinge() {
  static const auto d =
      std::make_shared<const Discretization>(one_wing(0.01, 0.009, 0.01, 0, true));
  return d;
}

Fabric hinge_fabric(double threshold_control, double scale) {
  Fabric fabric;
  fabric.k_bu = fabric.k_bv = fabric.k_bh = 1e-7;
  fabric.s_bu = fabric.s_bv = fabric.s_bh = scale;
  fabric.t_bu = fabric.t_bv = fabric.t_bh = threshold_control;
  return fabric;
}

double hinge_angle(const VecX& x) {
  Corners4<double> corners;
  const Wing& wing = hinge()->mesh().wings[0];
  for (size_t k = 0; k < 4; ++k)
    corners.col(static_cast<Eigen::Index>(k)) = position(x, wing.vertices[k]);
  return std::abs(fold_angle(corners));
}

constexpr BendingReading kRadiusTangent{BendingLaw::tangent, BendingThreshold::radius};
constexpr BendingReading kRadiusSecant{BendingLaw::secant, BendingThreshold::radius};

/// The threshold control at which a wing of the hinge has the threshold `angle`.
double threshold_control_of(double angle) {
  double low = 0.1, high = 0.9;  // the threshold falls as the control rises
  for (int i = 0; i < 60; ++i) {
    const double t = (low + high) / 2;
    const double threshold =
        wing_law(hinge()->mesh().wings[0], hinge_fabric(t, 1), kRadiusTangent).threshold;
    (threshold > angle ? low : high) = t;
  }
  return high;
}

TEST(HardEquilibrium, AWingOnItsThresholdConverges) {
  // Where the law does not change past the threshold the drape is found without noticing it; its
  // angle made the threshold, the moment there is the same whatever the scale.
  const Potential smooth(hinge(), hinge_fabric(0.1, 1), kRadiusTangent, kGravity);
  const Equilibrium reference =
      solve_equilibrium(smooth, flat_state(hinge()->mesh()), {.tolerance = 1e-12});
  ASSERT_TRUE(reference.converged());
  const double angle = hinge_angle(reference.x);
  ASSERT_GT(angle, 0.1);
  const double control = threshold_control_of(angle);
  for (const double scale : {0.1, 0.5, 5.0, 100.0}) {
    const Potential E(hinge(), hinge_fabric(control, scale), kRadiusTangent, kGravity);
    ASSERT_NEAR(wing_law(hinge()->mesh().wings[0], E.fabric(), kRadiusTangent).threshold, angle,
                1e-13);
    const VecX flat = flat_state(hinge()->mesh());
    for (const VecX& start : {flat, reference.x}) {
      const Equilibrium drape = solve_equilibrium(E, start);
      ASSERT_TRUE(drape.converged()) << "scale " << scale << ", " << name(drape.status);
      EXPECT_EQ(drape.negative_eigenvalues, 0);
      EXPECT_NEAR(hinge_angle(drape.x), angle, 1e-7);  // residual 1e-8, softened up to ten times
    }
  }
}

TEST(HardEquilibrium, DrapesWithManyWingsPastTheirThresholdConverge) {
  for (const double scale : {0.2, 5.0}) {
    Fabric fabric = medium_fabric();
    fabric.s_bu = fabric.s_bv = fabric.s_bh = scale;
    const Potential E(small_disc(), fabric, kRadiusTangent, kGravity);
    const Equilibrium drape = drape_by_lobes(E, kCusick, 5, 0);
    ASSERT_TRUE(drape.converged()) << name(drape.status) << ", residual " << drape.residual;
    EXPECT_EQ(drape.negative_eigenvalues, 0);
    EXPECT_GT(E.wings_past_threshold(drape.x), 10);
    EXPECT_LT(E.wings_past_threshold(drape.x), static_cast<int>(E.mesh().wings.size()));
  }
}

TEST(HardEquilibrium, ReportsStagnationAtAJumpOfTheEnergy) {
  // The literal law jumps up by more than gravity can give: the hinge falls to its threshold, and
  // there is no equilibrium on either side of it.
  const double threshold = 0.1;
  const Potential E(hinge(), hinge_fabric(threshold_control_of(threshold), 10), kRadiusSecant,
                    kGravity);
  const VecX flat = flat_state(hinge()->mesh());
  const Equilibrium fallen = solve_equilibrium(E, flat);
  for (const VecX& start : {flat, fallen.x}) {  // also from the threshold itself
    const Equilibrium drape = solve_equilibrium(E, start);
    EXPECT_EQ(drape.status, EquilibriumStatus::stagnated) << name(drape.status);
    EXPECT_FALSE(drape.converged());
    EXPECT_EQ(drape.factor, nullptr);
    EXPECT_EQ(drape.negative_eigenvalues, -1);  // a factor was not asked for: not certified
    EXPECT_GT(drape.residual, 1e-3);
    EXPECT_GT(drape.residual, drape.rounding_floor);
    EXPECT_LT(drape.newton_iterations, 500);
    EXPECT_LE(drape.energy, E.energy(start));
    EXPECT_NEAR(hinge_angle(drape.x), threshold, 1e-6);
    EXPECT_LT(hinge_angle(drape.x), threshold);
  }
}

TEST(HardEquilibrium, PassesJumpsOfTheLiteralLaw) {
  // past its threshold a wing has half the energy: on the way back it stands before a wall
  int converged = 0;
  for (const int lobes : {4, 5, 6}) {
    Fabric fabric = medium_fabric();
    fabric.s_bu = fabric.s_bv = fabric.s_bh = 0.5;
    const Potential E(small_disc(), fabric, kRadiusSecant, kGravity);
    const Equilibrium drape = drape_by_lobes(E, kCusick, lobes, 0.1);
    EXPECT_GT(E.wings_past_threshold(drape.x), 0);
    EXPECT_LE(drape.energy, E.energy(flat_state(E.mesh())));
    converged += drape.converged();
  }
  EXPECT_EQ(converged, 3);
}

TEST(HardEquilibrium, TheLiteralLawStagnatesOnADrape) {
  Fabric fabric = medium_fabric();
  fabric.s_bu = fabric.s_bv = fabric.s_bh = 3;
  const Potential E(small_disc(), fabric, kRadiusSecant, kGravity);
  const Equilibrium drape = drape_by_lobes(E, kCusick, 5, 0);
  EXPECT_EQ(drape.status, EquilibriumStatus::stagnated) << name(drape.status);
  EXPECT_TRUE(drape.x.allFinite());
  EXPECT_EQ(drape.residual, E.residual(E.gradient(drape.x)));
  EXPECT_EQ(drape.factor, nullptr);
}

TEST(HardEquilibrium, ReportsTheIterationLimit) {
  const Potential E = potential(small_disc(), medium_fabric());
  const Equilibrium drape = solve_equilibrium(E, folded_state(small_disc()->mesh(), kCusick, 5, 0),
                                              {.max_iterations = 2});
  EXPECT_EQ(drape.status, EquilibriumStatus::iteration_limit);
  EXPECT_FALSE(drape.converged());
  EXPECT_EQ(drape.newton_iterations, 2);
  EXPECT_EQ(drape.negative_eigenvalues, -1);
  EXPECT_EQ(drape.factor, nullptr);
  EXPECT_GT(drape.residual, 1e-8);
  EXPECT_THROW(smallest_eigenvalue(drape), std::invalid_argument);
}

TEST(HardEquilibrium, ReportsAStartThatIsNotFinite) {
  const Potential E = potential(small_disc(), medium_fabric());
  VecX x = flat_state(small_disc()->mesh());
  x[3 * small_disc()->free_vertices()[0]] = std::numeric_limits<double>::quiet_NaN();
  const Equilibrium drape = solve_equilibrium(E, x);
  EXPECT_EQ(drape.status, EquilibriumStatus::non_finite);
  EXPECT_EQ(drape.factor, nullptr);
  EXPECT_EQ(drape.negative_eigenvalues, -1);
  EXPECT_EQ(drape.newton_iterations, 0);
}

}  // namespace
}  // namespace drape::test
