#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "core/drape_protocol.h"
#include "core/equilibrium.h"
#include "tests/support/derivative_check.h"
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

TEST(Equilibrium, ConvergesToCertifiedMinima) {
  for (const Fabric& fabric : {stiff_fabric(), medium_fabric()}) {
    const Potential E = potential(small_disc(), fabric);
    const Equilibrium drape = drape_by_lobes(E, kCusick, 5, 0);
    ASSERT_TRUE(drape.converged()) << name(drape.status) << ", residual " << drape.residual;
    EXPECT_LE(drape.residual, 1e-8);
    EXPECT_EQ(drape.residual, E.residual(E.gradient(drape.x)));
    EXPECT_EQ(drape.energy, E.energy(drape.x));
    EXPECT_EQ(drape.negative_eigenvalues, 0);
    SparseMatrix H;
    E.hessian(drape.x, 0, H);
    EXPECT_EQ(negative_eigenvalues(H), 0);
    EXPECT_GT(smallest_eigenvalue(drape), 0);
    // the factor it carries is that of the true Hessian at x
    Random random(1);
    const VecX b = random_vector(H.rows(), random);
    const VecX solved = drape.factor->solve(b);
    EXPECT_LE((H.selfadjointView<Eigen::Lower>() * solved - b).norm(), 1e-8 * b.norm());
  }
}

TEST(Equilibrium, FixedVerticesStay) {
  const Equilibrium drape = drape_by_lobes(potential(small_disc(), stiff_fabric()), kCusick, 4, 0);
  const Mesh& mesh = small_disc()->mesh();
  const VecX flat = flat_state(mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.fixed[static_cast<size_t>(v)]) {
      EXPECT_EQ(position(drape.x, v), position(flat, v));
    }
}

TEST(Equilibrium, AStiffFabricForgetsTheNoiseOfItsStart) {
  const Potential E = potential(small_disc(), stiff_fabric());
  const Equilibrium reference = drape_by_ramp(E, 1);
  ASSERT_TRUE(reference.converged());
  for (const std::uint64_t seed : {2, 3}) {
    const Equilibrium other = drape_by_ramp(E, seed);
    ASSERT_TRUE(other.converged());
    // two states of residual 1e-8 on one branch
    EXPECT_LE((other.x - reference.x).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST(Equilibrium, OnlyStiffnessOverWeightIsSeen) {
  Fabric fabric = medium_fabric();
  const Equilibrium light = drape_by_lobes(potential(small_disc(), fabric), kCusick, 6, 0.1);
  for (const Parameter p : {Parameter::areal_density, Parameter::k_u, Parameter::k_v,
                            Parameter::k_h, Parameter::k_bu, Parameter::k_bv, Parameter::k_bh})
    fabric[p] *= 3;
  const Equilibrium heavy = drape_by_lobes(potential(small_disc(), fabric), kCusick, 6, 0.1);
  ASSERT_TRUE(light.converged());
  ASSERT_TRUE(heavy.converged());
  EXPECT_LE((heavy.x - light.x).cwiseAbs().maxCoeff(), 1e-7);  // both to a residual of 1e-8
}

#ifdef DRAPE_WITH_CHOLMOD
TEST(Equilibrium, BothFactorisationsGiveTheSameDrape) {
  const Equilibrium a =
      drape_by_lobes(potential(disc(300, FactorBackend::cholmod), medium_fabric()), kCusick, 5, 0,
                     {.tolerance = 1e-10});
  const Equilibrium b = drape_by_lobes(potential(disc(300, FactorBackend::eigen), medium_fabric()),
                                       kCusick, 5, 0, {.tolerance = 1e-10});
  ASSERT_TRUE(a.converged());
  ASSERT_TRUE(b.converged());
  EXPECT_LE((a.x - b.x).cwiseAbs().maxCoeff(), 1e-9);
}
#endif

TEST(Equilibrium, LeavesASaddle) {
  // flat, clamped at both ends and compressed along its length: Euler's column
  const Mesh column = strip(0.06, 0.01, 2);
  std::vector<std::uint8_t> fixed = column.fixed;
  const double end = column.rest_uv.col(0).maxCoeff();
  for (int v = 0; v < column.vertex_count(); ++v)
    if (column.rest_uv(v, 0) > end - 1e-9) fixed[static_cast<size_t>(v)] = 1;
  const auto d =
      std::make_shared<const Discretization>(make_mesh(column.rest_uv, column.triangles, fixed));
  Potential E(d, stiff_fabric(), {}, 1e-9);  // weight sets the scale of residuals only
  VecX x = flat_state(d->mesh());
  for (int v = 0; v < d->mesh().vertex_count(); ++v)
    if (x[3 * v] > 0) x[3 * v] *= 0.98;
  EquilibriumOptions loose{.tolerance = 1e3};
  const Equilibrium buckled = solve_equilibrium(E, x, loose);
  ASSERT_TRUE(buckled.converged()) << name(buckled.status);
  double rise = 0;
  for (int v = 0; v < d->mesh().vertex_count(); ++v)
    rise = std::max(rise, std::abs(buckled.x[3 * v + 2]));
  // inextensible clamped column: end shortening (pi rise / length)^2 / 4 = 0.02
  EXPECT_NEAR(rise, 2 * std::sqrt(0.02) / M_PI * end, 0.1 * rise);
}

TEST(Equilibrium, TheSymmetricFlatDiscFindsAMinimum) {
  const Potential E = potential(small_disc(), medium_fabric());
  const Equilibrium drape = solve_equilibrium(E, flat_state(small_disc()->mesh()));
  ASSERT_TRUE(drape.converged()) << name(drape.status) << " " << drape.residual;
  EXPECT_EQ(drape.negative_eigenvalues, 0);
  EXPECT_LT(drape.energy, 0);  // gravity's work exceeds the strain energy
}

TEST(Equilibrium, ReportsTheIterationLimit) {
  const Potential E = potential(small_disc(), medium_fabric());
  const Equilibrium drape = solve_equilibrium(E, folded_state(small_disc()->mesh(), kCusick, 5, 0),
                                              {.max_iterations = 2});
  EXPECT_EQ(drape.status, EquilibriumStatus::iteration_limit);
  EXPECT_FALSE(drape.converged());
  EXPECT_EQ(drape.newton_iterations, 2);
  EXPECT_EQ(drape.factor, nullptr);
  EXPECT_GT(drape.residual, 1e-8);
  EXPECT_THROW(smallest_eigenvalue(drape), std::invalid_argument);
}

TEST(Equilibrium, ReportsAStartThatIsNotFinite) {
  const Potential E = potential(small_disc(), medium_fabric());
  VecX x = flat_state(small_disc()->mesh());
  x[3 * small_disc()->free_vertices()[0]] = std::numeric_limits<double>::quiet_NaN();
  const Equilibrium drape = solve_equilibrium(E, x);
  EXPECT_EQ(drape.status, EquilibriumStatus::non_finite);
  EXPECT_EQ(drape.factor, nullptr);
}

TEST(Equilibrium, WithoutCertificateThereIsNoFactor) {
  const Potential E = potential(small_disc(), stiff_fabric());
  const Equilibrium drape = drape_by_lobes(E, kCusick, 4, 0, {.certify = false});
  EXPECT_TRUE(drape.converged());
  EXPECT_EQ(drape.factor, nullptr);
}

TEST(Equilibrium, RoundingFloorBoundsAnImpossibleTolerance) {
  const Potential E = potential(small_disc(), stiff_fabric());
  const Equilibrium drape = drape_by_lobes(E, kCusick, 4, 0, {.tolerance = 1e-30});
  ASSERT_TRUE(drape.converged()) << name(drape.status) << ", residual " << drape.residual;
  EXPECT_GT(drape.rounding_floor, 0);
  EXPECT_LE(drape.residual, drape.rounding_floor);
  EXPECT_LT(drape.rounding_floor, 1e-8);
}

}  // namespace
}  // namespace drape::test
