#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/drape_protocol.h"
#include "core/potential.h"
#include "tests/support/derivative_check.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

constexpr double kGravity = 9.80665;
constexpr BendingReading kReadings[] = {{BendingLaw::tangent, BendingThreshold::printed},
                                        {BendingLaw::tangent, BendingThreshold::radius}};

Guide lobed_guide() {
  VecX radius(kProfileSize);
  for (int i = 0; i < kProfileSize; ++i)
    radius[i] = 0.12 + 0.01 * std::cos(5 * 2 * M_PI * i / kProfileSize + 0.3);
  return {harmonics(radius, 12), Vec2(2e-3, -1e-3), 0.7};
}

/// A crumpled disc with wings in both regimes.
class PotentialTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    disc_ = disc(300);
    x_ = shaken(disc_->mesh(), folded_state(disc_->mesh(), kCusick, 6, 0.2), 2e-3);
  }
  static void TearDownTestSuite() { disc_.reset(); }

  static Potential potential(BendingReading reading) {
    return Potential(disc_, medium_fabric(), reading, kGravity);
  }

  static std::shared_ptr<const Discretization> disc_;
  static VecX x_;
};
std::shared_ptr<const Discretization> PotentialTest::disc_;
VecX PotentialTest::x_;

TEST_F(PotentialTest, GradientAgainstEnergy) {
  for (const BendingReading reading : kReadings)
    for (const bool guided : {false, true}) {
      Potential E = potential(reading);
      if (guided) E.set_guide(lobed_guide());
      if (reading.threshold == BendingThreshold::radius) {
        ASSERT_GT(E.wings_past_threshold(x_), 0);
        ASSERT_LT(E.wings_past_threshold(x_), static_cast<int>(disc_->mesh().wings.size()));
      }
      const VecX g = E.gradient(x_);
      Random random(2);
      for (int trial = 0; trial < 5; ++trial) {
        const VecX d = disc_->to_full(disc_->to_free(random_vector(x_.size(), random)));
        const auto along = [&](double t) -> VecX {
          return VecX::Constant(1, E.energy(x_ + t * d));
        };
        const DerivativeError check = check_derivative(along, 0, VecX::Constant(1, g.dot(d)), 1e-3);
        EXPECT_LE(check.error, 1e-7) << name(reading.threshold) << ": " << check;
        const auto energy = [&](const VecX& x) { return E.energy(x); };
        EXPECT_NEAR(taylor_slope(energy, x_, g, d, 1e-7), 2, 0.1);
      }
    }
}

TEST_F(PotentialTest, EnergyAndGradientAtOnce) {
  for (const bool guided : {false, true}) {
    Potential E = potential(kReadings[1]);
    if (guided) E.set_guide(lobed_guide());
    VecX g(5);  // of another size
    const double energy = E.energy_and_gradient(x_, g);
    EXPECT_NEAR(energy, E.energy(x_), 1e-15 * energy);  // one sum, compiled twice
    EXPECT_EQ(g, E.gradient(x_));
    E.energy_and_gradient(flat_state(disc_->mesh()), g);
    E.energy_and_gradient(x_, g);
    EXPECT_EQ(g, E.gradient(x_));  // nothing is left of the evaluation before
  }
}

TEST_F(PotentialTest, HessianIsFilledInPlace) {
  const Potential E = potential(kReadings[1]);
  SparseMatrix H, reference;
  E.hessian(x_, 0, reference);
  E.hessian(flat_state(disc_->mesh()), 0.5, H);
  const double* const values = H.valuePtr();
  E.hessian(x_, 0, H);
  EXPECT_EQ(H.valuePtr(), values);
  EXPECT_EQ((H - reference).norm(), 0);
  SparseMatrix other(H.rows(), H.cols());
  other.setIdentity();
  E.hessian(x_, 0, other);
  EXPECT_EQ((other - reference).norm(), 0);
}

TEST_F(PotentialTest, HessianAgainstGradient) {
  for (const BendingReading reading : kReadings)
    for (const bool guided : {false, true}) {
      Potential E = potential(reading);
      if (guided) E.set_guide(lobed_guide());
      SparseMatrix H;
      E.hessian(x_, 0, H);
      const MatX full = full_matrix(H);
      Random random(3);
      for (int trial = 0; trial < 5; ++trial) {
        const VecX d = random_vector(H.rows(), random);
        const auto along = [&](double t) -> VecX {
          return disc_->to_free(E.gradient(x_ + t * disc_->to_full(d)));
        };
        const DerivativeError check = check_derivative(along, 0, full * d, 1e-3);
        EXPECT_LE(check.error, 1e-7) << name(reading.threshold) << ": " << check;
      }
    }
}

TEST_F(PotentialTest, FullBlendIsPositiveDefinite) {
  SparseMatrix H;
  const Potential E = potential({});
  E.hessian(x_, 0, H);
  EXPECT_GT(negative_eigenvalues(H), 0);  // crumpled: compressed triangles
  E.hessian(x_, 1, H);
  EXPECT_EQ(negative_eigenvalues(H), 0);
}

TEST_F(PotentialTest, GradientDfabricAgainstDifferencesForAllParameters) {
  for (const BendingReading reading : kReadings)
    for (const bool guided : {false, true}) {
      Potential E = potential(reading);
      if (guided) E.set_guide(lobed_guide());
      const MatX dg = E.gradient_dfabric(x_);
      for (const Parameter p : all_parameters()) {
        const auto gradient = [&](double value) {
          Fabric fabric = medium_fabric();
          fabric[p] = value;
          E.set_fabric(fabric);
          return E.gradient(x_);
        };
        const double value = medium_fabric()[p];
        const VecX column = dg.col(static_cast<int>(p));
        // steps up to 1 % only: further out, some wing crosses its threshold
        const DerivativeError check = check_derivative(gradient, value, column, 0.1 * value);
        if (column.norm() == 0) {  // printed reading: no wing is folded beyond 130 degrees
          EXPECT_GE(static_cast<int>(p), static_cast<int>(Parameter::s_bu)) << name(p);
          EXPECT_EQ(check.difference, 0) << name(p);
          continue;
        }
        // the gradient's largest entries, times eps, over the step: rounding of stretch in bending
        EXPECT_LE(check.error, 1e-6) << name(p) << ", " << name(reading.threshold) << ": " << check;
      }
      E.set_fabric(medium_fabric());
    }
}

TEST_F(PotentialTest, TransposedDfabricIsTheTranspose) {
  for (const bool guided : {false, true}) {
    Potential E = potential(kReadings[1]);
    if (guided) E.set_guide(lobed_guide());
    Random random(4);
    const VecX lambda = disc_->to_full(disc_->to_free(random_vector(x_.size(), random)));
    const MatX dg = E.gradient_dfabric(x_);
    const ParameterVector transposed = E.gradient_dfabric_transposed(x_, lambda);
    for (int p = 0; p < kParameterCount; ++p)  // sums of some thousand terms in another order
      EXPECT_NEAR(transposed[p], dg.col(p).dot(lambda), 1e-12 * dg.col(p).norm() * lambda.norm());
  }
}

TEST_F(PotentialTest, AnyNumberOfThreadsGivesTheSameBits) {
  Potential E = potential(kReadings[1]);
  E.set_guide(lobed_guide());
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const double energy = E.energy(x_);
  const VecX g = E.gradient(x_);
  SparseMatrix H, other;
  E.hessian(x_, 0.3, H);
  for (const int count : {2, 4}) {
    omp_set_num_threads(count);
    EXPECT_EQ(E.energy(x_), energy);
    EXPECT_EQ(E.gradient(x_), g);
    E.hessian(x_, 0.3, other);
    EXPECT_EQ(Eigen::Map<const VecX>(other.valuePtr(), other.nonZeros()),
              Eigen::Map<const VecX>(H.valuePtr(), H.nonZeros()));
  }
  omp_set_num_threads(threads);
}

TEST_F(PotentialTest, FixedRowsAreZero) {
  Potential E = potential(kReadings[1]);
  E.set_guide(lobed_guide());
  const VecX g = E.gradient(x_);
  const MatX dg = E.gradient_dfabric(x_);
  for (int v = 0; v < disc_->mesh().vertex_count(); ++v) {
    if (!disc_->mesh().fixed[static_cast<size_t>(v)]) continue;
    EXPECT_EQ(position(g, v), Vec3(0, 0, 0));
    EXPECT_TRUE(dg.middleRows(3 * v, 3).isZero(0));
  }
}

TEST_F(PotentialTest, GravityPullsWithTheWeightOfTheFreeCloth) {
  const Potential E = potential({});
  const VecX flat = flat_state(disc_->mesh());
  const VecX g = E.gradient(flat);
  double down = 0;
  for (int v = 0; v < disc_->mesh().vertex_count(); ++v) down += g[3 * v + 2];
  EXPECT_NEAR(down, E.free_weight(), 1e-12 * E.free_weight());
  VecX lifted = flat;
  for (int v = 0; v < disc_->mesh().vertex_count(); ++v) lifted[3 * v + 2] += 1;
  // lifting everything by a metre: areal density times the area of the mesh; rounding of k h^2
  const double weight = 0.2 * kGravity * disc_->mesh().nodal_area.sum();
  EXPECT_NEAR(E.energy(lifted) - E.energy(flat), weight, 1e-12);
  double largest = 0;  // flat, the residual is the largest free weight over the largest weight
  for (const int v : disc_->free_vertices())
    largest = std::max(largest, disc_->mesh().nodal_area[v]);
  EXPECT_NEAR(E.residual(g), largest / disc_->mesh().nodal_area.maxCoeff(), 1e-9);
}

TEST_F(PotentialTest, RestStateIsWithoutForceUnderNoGravity) {
  Potential E = potential({});
  E.set_gravity(0);
  const VecX flat = flat_state(disc_->mesh());
  EXPECT_LE(E.energy(flat), 1e-25);
  EXPECT_LE(E.gradient(flat).cwiseAbs().maxCoeff(), 1e-11);  // 1e3 N/m times 0.15 m times eps
}

TEST_F(PotentialTest, WingRegimesAreCounted) {
  const Potential E = potential(kReadings[1]);
  const std::vector<bool> past = E.wing_regimes(x_);
  EXPECT_EQ(past.size(), disc_->mesh().wings.size());
  EXPECT_EQ(E.wings_past_threshold(x_), std::count(past.begin(), past.end(), true));
  EXPECT_EQ(E.wings_past_threshold(flat_state(disc_->mesh())), 0);
}

TEST_F(PotentialTest, CollapsedTriangleIsNotFinite) {
  VecX x = x_;
  const Eigen::RowVector3i t = disc_->mesh().triangles.row(disc_->active_triangles()[0]);
  for (int k = 1; k < 3; ++k) x.segment<3>(3 * t[k]) = position(x, t[0]);
  EXPECT_FALSE(potential({}).gradient(x).allFinite());
  EXPECT_TRUE(std::isinf(potential({}).residual(potential({}).gradient(x))));
}

TEST_F(PotentialTest, RefusesBadInput) {
  Fabric bad = medium_fabric();
  bad.k_h = 0;
  EXPECT_THROW(Potential(disc_, bad, {}, kGravity), std::invalid_argument);
  EXPECT_THROW(Potential(disc_, medium_fabric(), {}, -1), std::invalid_argument);
  Potential E = potential({});
  EXPECT_THROW(E.set_gravity(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(E.set_fabric(bad), std::invalid_argument);
  EXPECT_EQ(E.fabric().k_h, medium_fabric().k_h);  // a refused fabric leaves the old one
}

}  // namespace
}  // namespace drape::test
