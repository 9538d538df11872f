#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/camera.h"
#include "core/outline.h"
#include "tests/support/derivative_check.h"
#include "tests/support/hyper_dual.h"
#include "tests/support/laid_out_cloth.h"

namespace drape::test {
namespace {

const Camera kPinhole{.height = 0.8};

/// Three points at different depths, one above the support.
VecX points() {
  VecX x(9);
  x << 0.1, 0.02, -0.05, -0.03, 0.12, 0.004, 0.0, -0.11, -0.1;
  return x;
}

TEST(Camera, OrthographicViewChangesNothing) {
  const Camera camera;
  EXPECT_TRUE(camera.orthographic());
  EXPECT_EQ(camera.seen(points()), points());
  EXPECT_EQ(camera.pull_back(points(), points()), points());
  EXPECT_EQ(camera.push_forward(points(), points()), points());
}

TEST(Camera, WhatHangsLowerLooksSmaller) {
  const VecX seen = kPinhole.seen(points());
  EXPECT_NEAR(seen[0], 0.1 * 0.8 / 0.85, 1e-16);
  EXPECT_NEAR(seen[4], 0.12 * 0.8 / 0.796, 1e-16);
  EXPECT_EQ(seen[2], -0.05);
  // a camera far away sees the orthographic view
  EXPECT_LE((Camera{.height = 1e9}.seen(points()) - points()).norm(), 1e-10);
}

TEST(Camera, DerivativesMatchDifferencesAndAreTransposed) {
  const VecX x = points();
  MatX J(9, 9), transposed(9, 9);
  for (int i = 0; i < 9; ++i) {
    J.col(i) = kPinhole.push_forward(x, VecX::Unit(9, i));
    transposed.col(i) = kPinhole.pull_back(x, VecX::Unit(9, i));
  }
  const auto f = [](const VecX& y) { return kPinhole.seen(y); };
  const DerivativeError check = check_jacobian(f, x, J, 0.1);
  EXPECT_LE(check.error, 1e-9) << check;  // truncation against rounding
  EXPECT_LE((J - transposed.transpose()).cwiseAbs().maxCoeff(), 1e-15);  // rounding
}

TEST(Camera, DerivativesAreTheAutomaticOnes) {
  const VecX x = points();
  for (int axis = 0; axis < 2; ++axis) {
    const auto seen = [&](const Eigen::Matrix<HyperDual, 3, 1>& y) {
      const HyperDual height(kPinhole.height);
      return height / (height - y[2]) * y[axis];
    };
    Vec3 gradient;
    Mat3 hessian;
    second_derivatives<3>(seen, Vec3(x.head<3>()), gradient, hessian);
    const VecX own = kPinhole.pull_back(x, VecX::Unit(9, axis));
    EXPECT_LE((own.head<3>() - gradient).norm(), 1e-15);  // rounding
  }
}

TEST(Camera, TheOutlineOfAPinholeDependsOnTheDepth) {
  const Mesh mesh = annulus(48, 4);
  const VecX x = state(mesh, swung);
  const auto area_of = [&](const VecX& y) {
    return area(trace_outline(mesh, kScene, kPinhole.seen(y)).points);
  };
  const VecX seen = kPinhole.seen(x);
  const Outline outline = trace_outline(mesh, kScene, seen);
  const VecX gradient =
      kPinhole.pull_back(x, pull_back(outline, seen, area_gradient(outline.points)));
  VecX deeper = VecX::Zero(x.size());
  for (int i = 0; i < mesh.vertex_count(); ++i)
    if (!mesh.fixed[static_cast<size_t>(i)]) deeper[3 * i + 2] = -1;
  EXPECT_LT(gradient.dot(deeper), 0);
  double best = 1;
  for (const double step : {1e-4, 1e-5, 1e-6})
    best = std::min(best, std::abs((area_of(x + step * deeper) - area_of(x - step * deeper)) /
                                       (2 * step * gradient.dot(deeper)) -
                                   1));
  EXPECT_LE(best, 1e-8);  // truncation against rounding
}

TEST(Camera, RefusesAPointAsHighAsItself) {
  VecX x = points();
  x[5] = 0.8;
  EXPECT_THROW(kPinhole.seen(x), std::runtime_error);
}

}  // namespace
}  // namespace drape::test
