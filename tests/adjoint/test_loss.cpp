#include <gtest/gtest.h>

#include <stdexcept>

#include "adjoint/loss.h"
#include "tests/support/derivative_check.h"
#include "tests/support/laid_out_cloth.h"

namespace drape::test {
namespace {

struct Case {
  Mesh mesh = annulus(48, 4);
  VecX x = state(mesh, swung);  // no corner lies on a ray of the profile
  Outline outline = trace_outline(mesh, kScene, x);
  Outline target = trace_outline(mesh, kScene, state(mesh, rough(3)));
};

/// The same outline with its corners elsewhere.
Outline with_points(const Outline& outline, const VecX& points) {
  Outline moved = outline;
  moved.points.reshaped<Eigen::RowMajor>() = points;
  return moved;
}

template <typename LossOf>
void expect_exact_derivative(const Outline& outline, const LossOf& loss_of) {
  const VecX points = outline.points.reshaped<Eigen::RowMajor>();
  const VecX gradient = loss_of(outline).dL_dpoints.template reshaped<Eigen::RowMajor>();
  Random random(1);
  for (int trial = 0; trial < 5; ++trial) {
    const VecX d = random_vector(points.size(), random);
    const auto along = [&](double t) {
      return VecX::Constant(1, loss_of(with_points(outline, points + t * d)).value);
    };
    // small steps only: further out a corner passes a ray or the edge of a pixel, where the loss
    // has a jump in its second derivative
    const DerivativeError check =
        check_derivative(along, 0, VecX::Constant(1, gradient.dot(d)), 1e-4);
    EXPECT_LE(check.error, 1e-6) << check;
  }
}

TEST(Loss, ProfileValueAndDerivative) {
  const Case c;
  const VecX observed = radial_profile(c.target.points).radius;
  const VecX rho = radial_profile(c.outline.points).radius;
  EXPECT_NEAR(profile_loss(c.outline, observed).value, 0.5 * (rho - observed).squaredNorm() / 360,
              1e-18);
  EXPECT_EQ(profile_loss(c.outline, rho).value, 0);
  expect_exact_derivative(c.outline, [&](const Outline& o) { return profile_loss(o, observed); });
  const Vec2 centre(3e-3, -2e-3);
  expect_exact_derivative(c.outline,
                          [&](const Outline& o) { return profile_loss(o, observed, centre); });
}

TEST(Loss, CoverageValueAndDerivative) {
  const Case c;
  const PixelGrid grid = centred_grid(64, 0.32);
  const CoverageImage observed = coverage(c.target.points, grid);
  const CoverageImage own = coverage(c.outline.points, grid);
  const double value = 0.5 * (own - observed).squaredNorm() * grid.pixel_size * grid.pixel_size;
  EXPECT_NEAR(coverage_loss(c.outline, grid, observed).value, value, 1e-15 * value);
  EXPECT_EQ(coverage_loss(c.outline, grid, own).value, 0);
  expect_exact_derivative(c.outline,
                          [&](const Outline& o) { return coverage_loss(o, grid, observed); });
}

TEST(Loss, DrapeCoefficientValueAndDerivative) {
  const Case c;
  EXPECT_NEAR(drape_coefficient_loss(c.outline, kScene).value,
              drape_coefficient(kScene, area(c.outline.points)), 1e-15);
  expect_exact_derivative(c.outline,
                          [](const Outline& o) { return drape_coefficient_loss(o, kScene); });
}

TEST(Loss, RefusesObservationsOfAnotherSize) {
  const Case c;
  EXPECT_THROW(profile_loss(c.outline, VecX::Zero(359)), std::invalid_argument);
  const PixelGrid grid = centred_grid(64, 0.32);
  EXPECT_THROW(coverage_loss(c.outline, grid, CoverageImage::Zero(64, 63)), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
