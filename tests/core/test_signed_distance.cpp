#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/signed_distance.h"
#include "tests/support/derivative_check.h"

namespace drape::test {
namespace {

/// A square of side 2 with a notch from above: a reflex corner at the origin.
Points2 notched() {
  Points2 polygon(5, 2);
  polygon << -1, -1, 1, -1, 1, 1, 0, 0, -1, 1;
  return polygon;
}

VecX distances_from(const Points2& polygon, const Points2& at) {
  return signed_distances(polygon, at).distance;
}

Points2 row(double x, double y) {
  Points2 point(1, 2);
  point << x, y;
  return point;
}

TEST(SignedDistance, IsPositiveOutsideAndNegativeInside) {
  const auto distance = [](double x, double y) { return distances_from(notched(), row(x, y))[0]; };
  EXPECT_DOUBLE_EQ(distance(0, -1.5), 0.5);                // below a side
  EXPECT_DOUBLE_EQ(distance(0.2, -0.9), -0.1);             // above it
  EXPECT_DOUBLE_EQ(distance(2, -2), std::numbers::sqrt2);  // off a corner that sticks out
  EXPECT_DOUBLE_EQ(distance(0, -0.25), -0.25);             // below the reflex corner
  EXPECT_DOUBLE_EQ(distance(0, 0.5), std::sqrt(0.125));    // in the notch
  EXPECT_NEAR(distance(0.4, -1), 0, 1e-16);                // on a side
  EXPECT_EQ(distance(1, -1), 0);                           // on a corner
}

TEST(SignedDistance, IsContinuousAcrossTheEndsOfAnEdge) {
  for (const double y : {-1.2, -0.8, 0.9})
    for (const double x : {1.0, -1.0, 0.0}) {
      const double before = distances_from(notched(), row(x - 1e-9, y))[0];
      const double beyond = distances_from(notched(), row(x + 1e-9, y))[0];
      EXPECT_NEAR(before, beyond, 4e-9) << x << " " << y;  // slope at most 1
    }
}

TEST(SignedDistance, DerivativesMatchDifferencesAndAreTransposed) {
  // beside an edge on both sides, off a corner, off the reflex corner, and in the notch
  Points2 at(5, 2);
  at << 0.3, -1.2, 0.3, -0.7, 1.3, -1.4, 0.02, -0.2, 0.1, 0.6;
  const VecX corners = notched().reshaped<Eigen::RowMajor>();
  const SignedDistances distances = signed_distances(notched(), at);
  MatX J(5, 10), transposed(10, 5);
  for (int k = 0; k < 10; ++k)
    J.col(k) = push_forward(distances, Points2(VecX::Unit(10, k).reshaped<Eigen::RowMajor>(5, 2)));
  for (int i = 0; i < 5; ++i)
    transposed.col(i) =
        pull_back(distances, notched(), VecX::Unit(5, i)).reshaped<Eigen::RowMajor>();
  const auto f = [&](const VecX& moved) {
    return distances_from(moved.reshaped<Eigen::RowMajor>(5, 2), at);
  };
  const DerivativeError check = check_jacobian(f, corners, J, 0.1);
  EXPECT_LE(check.error, 1e-9) << check;  // truncation against rounding
  EXPECT_LE((J - transposed.transpose()).cwiseAbs().maxCoeff(), 1e-15);  // rounding
}

TEST(SignedDistance, EqualStepsAlongAPolygon) {
  Points2 square(4, 2);
  square << 0, 0, 2, 0, 2, 2, 0, 2;
  const Points2 points = equally_spaced(square, 16);
  for (int i = 0; i < 16; ++i)
    EXPECT_NEAR((points.row((i + 1) % 16) - points.row(i)).norm(), 0.5, 1e-15) << i;  // rounding
  EXPECT_EQ(points.row(5), Points2(row(2, 0.5)).row(0));
}

TEST(SignedDistance, RefusesWhatIsNoPolygon) {
  EXPECT_THROW(signed_distances(notched().topRows(2), row(0, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
