#include "estimation/ridge_regression.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/random.h"

namespace drape::test {
namespace {

MatX random_matrix(int rows, int columns, Random& random) {
  return MatX::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

TEST(RidgeRegression, IsItsFormula) {
  Random random(1);
  MatX X = random_matrix(12, 5, random);
  X.col(4) = X.col(0) - 2 * X.col(1);  // collinear: the penalty alone decides
  const MatX Z = random_matrix(12, 2, random);
  const VecX x = random_matrix(5, 1, random), penalties = Vec2(0.1, 30);
  const RidgeRegression ridge(X, Z);

  const VecX mean_x = X.colwise().mean();
  X.rowwise() -= mean_x.transpose();
  for (int j = 0; j < 2; ++j) {
    const MatX inverse = (X.transpose() * X + penalties[j] * MatX::Identity(5, 5))
                             .ldlt()
                             .solve(MatX::Identity(5, 5));
    const VecX centred = x - mean_x;
    const double mean = Z.col(j).mean() + centred.dot(inverse * X.transpose() * Z.col(j));
    const double h = 1. / 12 + centred.dot(inverse * centred);
    // rounding: the condition is about 1e3
    EXPECT_NEAR(ridge.mean(x, penalties)[j], mean, 1e-11);
    EXPECT_NEAR(ridge.error_factors(x, penalties)[j], std::sqrt(1 + h), 1e-11);
  }
}

TEST(RidgeRegression, TheInterceptHasNoPenalty) {
  Random random(2);
  const MatX X = random_matrix(30, 3, random), Z = MatX::Constant(30, 1, 7) + X.col(0);
  const RidgeRegression ridge(X, Z);
  const VecX far = Vec3(10, 0, 0);
  EXPECT_NEAR(ridge.mean(far, VecX::Constant(1, 1e12))[0], Z.mean(), 1e-8);
  EXPECT_NEAR(ridge.mean(far, VecX::Constant(1, 1e-9))[0], 17, 1e-6);  // off by penalty / n
}

}  // namespace
}  // namespace drape::test
