#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

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

TEST(Equilibrium, WithoutCertificateThereIsNoFactor) {
  const Potential E = potential(small_disc(), stiff_fabric());
  const Equilibrium drape = drape_by_lobes(E, kCusick, 4, 0, {.certify = false});
  EXPECT_TRUE(drape.converged());
  EXPECT_EQ(drape.factor, nullptr);
  EXPECT_EQ(drape.negative_eigenvalues, -1);
}

TEST(Equilibrium, StopsWhenItIsTold) {
  const Potential E = potential(small_disc(), stiff_fabric());
  int calls = 0;
  EquilibriumOptions options;
  options.go_on = [&](const VecX& x, const VecX& gradient) {
    EXPECT_EQ(gradient, E.gradient(x));
    return ++calls < 5;
  };
  const VecX start = folded_state(E.mesh(), kCusick, 4, 0);
  const Equilibrium stopped = solve_equilibrium(E, start, options);
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(stopped.status, EquilibriumStatus::iteration_limit);
  EXPECT_EQ(stopped.x, solve_equilibrium(E, start, {.max_iterations = 5}).x);
}

TEST(Equilibrium, ANearbyFactorSavesFactorisations) {
  const EquilibriumOptions tight{.tolerance = 1e-9};
  int with_factor = 0, without = 0;
  for (Fabric fabric : {stiff_fabric(), medium_fabric()}) {
    Potential E = potential(small_disc(), fabric);
    const Equilibrium first = drape_by_lobes(E, kCusick, 5, 0, tight);
    ASSERT_TRUE(first.converged());
    ASSERT_EQ(first.preconditioner, first.factor);
    Random random(1);
    const VecX b = random_vector(first.factor->size(), random);
    const VecX before = first.factor->solve(b);

    for (const Parameter k : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh}) fabric[k] *= 1.03;
    E.set_fabric(fabric);
    const Equilibrium cold = solve_equilibrium(E, first.x, tight);
    const Equilibrium warm = solve_equilibrium(E, first.x, tight, first.preconditioner);
    ASSERT_TRUE(cold.converged());
    ASSERT_TRUE(warm.converged());
    EXPECT_GT((cold.x - first.x).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LE((cold.x - warm.x).cwiseAbs().maxCoeff(), 1e-9);
    with_factor += warm.factorizations;
    without += cold.factorizations;
    // the factor that was lent is as it was, and the result's own one is another
    EXPECT_EQ(first.factor->solve(b), before);
    EXPECT_NE(warm.factor, first.factor);
    EXPECT_NE(VecX(warm.factor->solve(b)), before);
  }
  EXPECT_LT(with_factor, without);
}

TEST(Equilibrium, ThreadsDoNotChangeABit) {
  const auto drape = [](const Fabric& fabric) {
    return drape_by_lobes(potential(small_disc(), fabric), kCusick, 5, 0);
  };
  const std::vector<Fabric> fabrics = {stiff_fabric(), medium_fabric()};
  std::vector<Equilibrium> alone, together(2);
  for (const Fabric& fabric : fabrics) alone.push_back(drape(fabric));
  {
    std::vector<std::thread> threads;
    for (size_t i = 0; i < 2; ++i)
      threads.emplace_back([&, i] { together[i] = drape(fabrics[i]); });
    for (std::thread& thread : threads) thread.join();
  }
  for (size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(alone[i].converged());
    EXPECT_EQ(together[i].x, alone[i].x);
    EXPECT_EQ(together[i].energy, alone[i].energy);
    EXPECT_EQ(together[i].residual, alone[i].residual);
    EXPECT_EQ(together[i].newton_iterations, alone[i].newton_iterations);
    EXPECT_EQ(together[i].factorizations, alone[i].factorizations);
  }
}

}  // namespace
}  // namespace drape::test
