#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/bending.h"
#include "tests/support/derivative_check.h"
#include "tests/support/element_kernels.h"
#include "tests/support/hyper_dual.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<BendingReading> readings() {
  return {{BendingLaw::tangent, BendingThreshold::printed},
          {BendingLaw::tangent, BendingThreshold::radius},
          {BendingLaw::secant, BendingThreshold::printed},
          {BendingLaw::secant, BendingThreshold::radius}};
}

std::string text(BendingReading r) {
  return std::string(name(r.law)) + ", " + std::string(name(r.threshold));
}

/// A wing bent in the direction `phi`, 20 mm high on average.
Wing wing_at(double phi, bool clamped = false) {
  return one_wing(0.015, 0.018, 0.022, phi - kPi / 2, clamped).wings.at(0);
}

/// Angles on both sides of the threshold, on it, and at the ends.
std::vector<double> angles(const WingLaw& law) {
  const double t = law.threshold;
  std::vector<double> list{0.01};
  for (const double d : {0.5 * t, t * (1 - 1e-9), t, t * (1 + 1e-9), 0.5 * (t + kPi), 3.1})
    if (d > 0.02 && d < kPi) list.push_back(d);
  const size_t n = list.size();
  for (size_t i = 0; i < n; ++i) list.push_back(-list[i]);
  return list;
}

TEST(Bending, InterpolationIsContinuousAndHitsTheThreeDirections) {
  EXPECT_EQ(interpolation_weights(0), Vec3(1, 0, 0));
  EXPECT_LE((interpolation_weights(kPi / 4) - Vec3(0, 0, 1)).norm(), 1e-15);
  EXPECT_LE((interpolation_weights(kPi / 2) - Vec3(0, 1, 0)).norm(), 1e-15);
  // half way towards the bias, on either side (Eq. 4 is linear in phi)
  EXPECT_LE((interpolation_weights(kPi / 8) - Vec3(0.5, 0, 0.5)).norm(), 1e-15);
  EXPECT_LE((interpolation_weights(3 * kPi / 8) - Vec3(0, 0.5, 0.5)).norm(), 1e-15);
  const Vec3 below = interpolation_weights(kPi / 4 * (1 - 1e-12));
  const Vec3 above = interpolation_weights(kPi / 4 * (1 + 1e-12));
  EXPECT_LE((below - above).norm(), 4e-12);
  for (double phi = 0; phi <= kPi / 2; phi += 0.01) {
    EXPECT_NEAR(interpolation_weights(phi).sum(), 1, 1e-15);
    EXPECT_GE(interpolation_weights(phi).minCoeff(), 0);
  }
}

TEST(Bending, ThresholdRadiusOfEq9) {
  EXPECT_DOUBLE_EQ(threshold_radius_mm(0), 0.01);
  EXPECT_DOUBLE_EQ(threshold_radius_mm(0.1), 1);
  EXPECT_DOUBLE_EQ(threshold_radius_mm(0.3), 25.75);
  EXPECT_DOUBLE_EQ(threshold_radius_mm(0.9), 100);
  EXPECT_DOUBLE_EQ(threshold_radius_mm(0.99), 10000);
  EXPECT_DOUBLE_EQ(threshold_radius_mm(1), 10000);
  for (const double kink : {0.1, 0.9, 0.99}) {  // continuous, with slopes up to 1.1e5 mm
    EXPECT_NEAR(threshold_radius_mm(kink - 1e-12), threshold_radius_mm(kink), 1e-6);
    EXPECT_NEAR(threshold_radius_mm(kink + 1e-12), threshold_radius_mm(kink), 1e-6);
  }
  for (const double t : {0.05, 0.099, 0.101, 0.3, 0.89, 0.91, 0.985, 0.995}) {
    const double slope = (threshold_radius_mm(t + 1e-4) - threshold_radius_mm(t - 1e-4)) / 2e-4;
    EXPECT_NEAR(threshold_radius_mm_derivative(t), slope, 1e-8 * (1 + slope))
        << t;  // linear pieces
  }
}

TEST(Bending, ThresholdAngleInBothReadings) {
  Fabric fabric;
  const Wing wing = wing_at(0.3);
  ASSERT_NEAR(wing.mean_height, 0.020, 1e-15);
  const double c = 20 / (2 * 25.75);  // L_avg / (2 R_b) at t_b = 0.3
  EXPECT_NEAR(wing_law(wing, fabric, {BendingLaw::tangent, BendingThreshold::printed}).threshold,
              2 * std::acos(c), 1e-14);
  EXPECT_NEAR(wing_law(wing, fabric, {BendingLaw::tangent, BendingThreshold::radius}).threshold,
              2 * std::asin(c), 1e-14);
  // model.md: 134, 158 and 169 degrees for wings 20, 10 and 5 mm high
  const std::pair<double, double> stated[] = {{0.020, 134}, {0.010, 158}, {0.005, 169}};
  for (const auto& [height, degrees] : stated) {
    const Wing other = one_wing(0.01, height, height, 0.2).wings.at(0);
    const WingLaw law = wing_law(other, fabric, {BendingLaw::tangent, BendingThreshold::printed});
    EXPECT_NEAR(law.threshold * 180 / kPi, degrees, 0.6);  // stated to a degree
  }
}

TEST(Bending, EndsOfTheThresholdControl) {
  const Wing wing = wing_at(0.9);
  Fabric fabric;
  fabric.t_bu = fabric.t_bv = fabric.t_bh = 0;
  const BendingReading printed{BendingLaw::tangent, BendingThreshold::printed};
  const BendingReading radius{BendingLaw::tangent, BendingThreshold::radius};
  EXPECT_EQ(wing_law(wing, fabric, printed).threshold, 0);  // printed 0: always past
  EXPECT_TRUE(past_threshold(wing_law(wing, fabric, printed), 0));
  EXPECT_NEAR(wing_law(wing, fabric, radius).threshold, kPi, 1e-15);  // radius 0: never
  EXPECT_FALSE(past_threshold(wing_law(wing, fabric, radius), 3.14));
  EXPECT_EQ(wing_law(wing, fabric, radius).threshold_derivative, 0);
  fabric.t_bu = fabric.t_bv = fabric.t_bh = 1;
  // R_b is 10 m, not infinite: the thresholds are L_avg/(2 R_b) = 1e-3 from the ends
  EXPECT_NEAR(wing_law(wing, fabric, printed).threshold, kPi - 2e-3, 1e-8);  // never
  EXPECT_NEAR(wing_law(wing, fabric, radius).threshold, 2e-3, 1e-8);         // at once
}

TEST(Bending, ClampLineWingsUseHalfTheHeightInRadiusOnly) {
  const Fabric fabric;
  const Wing free = wing_at(0.4), clamped = wing_at(0.4, true);
  ASSERT_TRUE(clamped.on_clamp_line);
  const BendingReading radius{BendingLaw::tangent, BendingThreshold::radius};
  EXPECT_NEAR(std::sin(wing_law(clamped, fabric, radius).threshold / 2),
              0.5 * std::sin(wing_law(free, fabric, radius).threshold / 2), 1e-15);
  EXPECT_EQ(wing_law(clamped, fabric, {}).threshold, wing_law(free, fabric, {}).threshold);
  EXPECT_DOUBLE_EQ(wing_law(clamped, fabric, {}).stiffness,
                   2 * wing_law(free, fabric, {}).stiffness);  // clamp_wing_factor
}

TEST(Bending, EnergyOfEq3BelowTheThreshold) {
  const Fabric fabric = medium_fabric();
  const Wing wing = wing_at(kPi / 2);
  const WingLaw law = wing_law(wing, fabric, {});
  // edge 15 mm, heights 18 and 22 mm; no factor 1/2
  EXPECT_NEAR(wing_energy(law, 0.2), fabric.k_bv * (15.0 / 18 + 15.0 / 22) * 0.04, 1e-20);
  EXPECT_EQ(wing_energy(law, 0.0), 0);
  EXPECT_EQ(wing_moment(law, 0), 0);
}

TEST(Bending, MomentAndTangentAgainstAutomaticDerivatives) {
  using Jet = ceres::Jet<double, 1>;
  for (const BendingReading reading : readings())
    for (const double phi : {0.0, 0.5, kPi / 4, 1.2, kPi / 2}) {
      const WingLaw law = wing_law(wing_at(phi), medium_fabric(), reading);
      for (const double delta : angles(law)) {
        const Jet e = wing_energy(law, Jet(delta, 0));
        const HyperDual second = wing_energy(law, HyperDual(delta, 1, 1, 0));
        EXPECT_DOUBLE_EQ(wing_energy(law, delta), e.a);
        EXPECT_NEAR(wing_moment(law, delta), e.v[0], 1e-13 * law.stiffness) << text(reading);
        EXPECT_NEAR(wing_tangent(law, delta), second.d, 1e-13 * law.stiffness) << text(reading);
      }
    }
}

TEST(Bending, MomentAgainstDifferencesOffTheKink) {
  for (const BendingReading reading : readings()) {
    const WingLaw law = wing_law(wing_at(0.5), medium_fabric(), reading);
    for (const double delta : {0.3 * law.threshold, -0.9 * law.threshold, (law.threshold + kPi) / 2,
                               -0.1 * law.threshold - 0.9 * kPi}) {
      const auto energy = [&](const VecX& d) { return wing_energy(law, d[0]); };
      const DerivativeError check = check_gradient(energy, VecX::Constant(1, delta),
                                                   VecX::Constant(1, wing_moment(law, delta)), 1);
      EXPECT_LE(check.error, 1e-9) << text(reading) << ": " << check;
    }
  }
}

TEST(Bending, TangentLawIsSmoothAtTheThreshold) {
  for (const BendingThreshold threshold : {BendingThreshold::printed, BendingThreshold::radius}) {
    const WingLaw law = wing_law(wing_at(0.5), medium_fabric(), {BendingLaw::tangent, threshold});
    ASSERT_GT(law.threshold, 0.1);
    ASSERT_LT(law.threshold, 3);
    for (const double sign : {1.0, -1.0}) {
      const double below = sign * std::nextafter(law.threshold, 0), at = sign * law.threshold;
      ASSERT_FALSE(past_threshold(law, below));
      ASSERT_TRUE(past_threshold(law, at));
      // one rounding step apart
      EXPECT_NEAR(wing_energy(law, below), wing_energy(law, at), 1e-14 * law.stiffness);
      EXPECT_NEAR(wing_moment(law, below), wing_moment(law, at), 1e-14 * law.stiffness);
      EXPECT_DOUBLE_EQ(wing_tangent(law, below), 2 * law.stiffness);
      EXPECT_DOUBLE_EQ(wing_tangent(law, at), 2 * law.stiffness * law.scale);
    }
  }
}

TEST(Bending, SecantLawJumpsByTheStatedAmount) {
  for (const BendingThreshold threshold : {BendingThreshold::printed, BendingThreshold::radius}) {
    const WingLaw law = wing_law(wing_at(0.5), medium_fabric(), {BendingLaw::secant, threshold});
    const double jump =
        wing_energy(law, std::nextafter(law.threshold, 0)) - wing_energy(law, law.threshold);
    // (1 - s_b) k_b w delta*^2
    EXPECT_NEAR(jump, (1 - law.scale) * law.stiffness * law.threshold * law.threshold,
                1e-13 * law.stiffness);
  }
}

TEST(Bending, ScaleOneKnowsNoThreshold) {
  Fabric fabric = medium_fabric();
  fabric.s_bu = fabric.s_bv = fabric.s_bh = 1;
  for (const BendingReading reading : readings()) {
    const WingLaw law = wing_law(wing_at(0.5), fabric, reading);
    for (const double delta : angles(law))
      EXPECT_NEAR(wing_energy(law, delta), law.stiffness * delta * delta, 1e-14 * law.stiffness);
  }
}

TEST(Bending, MomentDfabricAgainstDifferences) {
  const Fabric fabric = medium_fabric();
  for (const BendingReading reading : readings())
    for (const double phi : {0.2, 0.7, 1.3}) {
      const Wing wing = wing_at(phi);
      const WingLaw law = wing_law(wing, fabric, reading);
      for (const double delta : {0.4 * law.threshold, -0.9 * law.threshold,
                                 0.8 * law.threshold + 0.2 * kPi, -(law.threshold + kPi) / 2}) {
        const Eigen::Matrix<double, 9, 1> dM = wing_moment_dfabric(law, delta);
        for (int p = 0; p < 9; ++p) {
          const Parameter parameter = static_cast<Parameter>(static_cast<int>(Parameter::k_bu) + p);
          const auto moment = [&](double value) -> VecX {
            Fabric changed = fabric;
            changed[parameter] = value;
            return VecX::Constant(1, wing_moment(wing_law(wing, changed, reading), delta));
          };
          // steps that stay on one side of every kink
          const DerivativeError check = check_derivative(
              moment, fabric[parameter], VecX::Constant(1, dM[p]), 0.1 * fabric[parameter]);
          const double magnitude = std::abs(wing_moment(law, delta)) / fabric[parameter];
          EXPECT_LE(std::abs(check.derivative - check.difference), 1e-8 * magnitude)
              << text(reading) << ", " << name(parameter) << ", delta " << delta << ": " << check;
        }
      }
    }
}

TEST(Bending, ThresholdControlActsOnlyThroughTangentPastIt) {
  const WingLaw law =
      wing_law(wing_at(0.7), medium_fabric(), {BendingLaw::tangent, BendingThreshold::radius});
  EXPECT_EQ(wing_moment_dfabric(law, 0.5 * law.threshold).tail<3>(), Vec3(0, 0, 0));
  EXPECT_GT(wing_moment_dfabric(law, 1.5 * law.threshold).tail<3>().norm(), 0);
}

TEST(Bending, EquilateralLatticeHasRigidityFour) {
  // inner wings of a lattice of equilateral triangles: 2 k_b kappa^2 per area in every direction
  const double h = 1e-3, kappa = 1;
  const Fabric fabric;
  for (const double bend : {0.0, 0.2, 0.5, 1.0, 1.4}) {
    double per_area = 0;
    for (const double edge : {0.0, kPi / 3, 2 * kPi / 3}) {
      // every two triangles of the lattice own one wing of each direction
      const Mesh mesh = one_wing(h, std::sqrt(0.75) * h, std::sqrt(0.75) * h, edge);
      Points2 uv = mesh.rest_uv;
      const Vec2 along(std::cos(edge), std::sin(edge)), across(-along.y(), along.x());
      uv.row(2) = (0.5 * h * along + std::sqrt(0.75) * h * across).transpose();
      uv.row(3) = (0.5 * h * along - std::sqrt(0.75) * h * across).transpose();
      const Mesh lattice = make_mesh(uv, mesh.triangles, {0, 0, 0, 0});
      const double area = lattice.nodal_area.sum();
      per_area += bending_energy(lattice, fabric, cylinder(lattice, kappa, bend)) / area;
    }
    // the fold angles are kappa h up to (kappa h)^3
    EXPECT_NEAR(per_area, 2 * fabric.k_bu * kappa * kappa, 1e-5 * fabric.k_bu) << bend;
  }
}

}  // namespace
}  // namespace drape::test
