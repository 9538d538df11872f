#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "estimation/bending_rigidity.h"
#include "estimation/posterior.h"
#include "tests/support/derivative_check.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

const ParameterSpace kSpace{{Parameter::k_bu, Parameter::k_bv, Parameter::k_h}, stiff_fabric()};

/// Rows of pictures above those of the prior, as a fit has them.
MatX with_prior_rows(const MatX& pictures, const MatX& prior_covariance) {
  MatX J(pictures.rows() + prior_covariance.rows(), pictures.cols());
  J.setZero();
  J.topRows(pictures.rows()) = pictures;
  const Eigen::Index p = prior_covariance.rows();
  J.bottomLeftCorner(p, p) = prior_covariance.llt().matrixL().solve(MatX::Identity(p, p));
  return J;
}

MatX some_rows(Eigen::Index rows, Eigen::Index columns) {
  Random random(3);
  return random_vector(rows * columns, random).reshaped(rows, columns);
}

TEST(Posterior, IndependentParametersAddTheirInformation) {
  const MatX pictures = Vec3(3, 1, 0).asDiagonal();  // k_h is not seen at all
  const MatX C = Vec3(1, 0.25, 4).asDiagonal();
  const Posterior found =
      laplace(kSpace, kSpace.encode(stiff_fabric()), with_prior_rows(pictures, C), C);
  // variance 1 / (9 + 1), 1 / (1 + 4), 4; shares 9 / 10, 1 / 5, 0 of the information
  EXPECT_LE((found.log_sd - Vec3(std::sqrt(0.1), std::sqrt(0.2), 2)).norm(), 1e-14);
  EXPECT_LE((found.picture_share - Vec3(0.9, 0.2, 0)).norm(), 1e-14);
  EXPECT_LE((found.direction_shares - Vec3(0.9, 0.2, 0)).norm(), 1e-14);
  // one prior standard deviation of one parameter each
  EXPECT_LE((found.directions.cwiseAbs() - MatX(Vec3(1, 0.5, 2).asDiagonal())).norm(), 1e-14);
}

TEST(Posterior, DirectionsSolveTheGeneralisedProblem) {
  MatX C = Vec3(1, 0.5, 2).asDiagonal();
  C(0, 1) = C(1, 0) = 0.3;
  // two nuisances beside z
  const MatX J = with_prior_rows(some_rows(7, 5), C);
  const Posterior found = laplace(kSpace, kSpace.encode(stiff_fabric()), J, C);
  const MatX S = (J.transpose() * J).inverse().topLeftCorner(3, 3);
  const MatX D = S.inverse() - C.inverse();
  EXPECT_LE((found.covariance - S).norm(), 1e-12);
  for (int k = 0; k < 3; ++k) {
    const VecX d = found.directions.col(k);
    const double lambda = found.direction_shares[k] / (1 - found.direction_shares[k]);
    EXPECT_LE((D * d - lambda * C.inverse() * d).norm(), 1e-10 * (1 + lambda)) << k;
    EXPECT_NEAR(d.dot(C.inverse() * d), 1, 1e-12);
    if (k > 0) {
      EXPECT_LE(found.direction_shares[k], found.direction_shares[k - 1]);
    }
  }
}

TEST(Posterior, WithoutPriorSharesAreAgainstAFactorOfE) {
  const MatX pictures = Vec3(3, 1, 0.5).asDiagonal();
  const Posterior found = laplace(kSpace, kSpace.encode(stiff_fabric()), pictures, MatX());
  EXPECT_LE((found.log_sd - Vec3(1.0 / 3, 1, 2)).norm(), 1e-14);
  EXPECT_LE((found.picture_share - Vec3(0.9, 0.5, 0.2)).norm(), 1e-14);
  EXPECT_LE((found.direction_shares - Vec3(0.9, 0.5, 0.2)).norm(), 1e-14);
}

TEST(Posterior, RigidityByTheDeltaMethod) {
  const VecX z = kSpace.encode(stiff_fabric());
  const MatX J = some_rows(7, 3);
  const Posterior found = laplace(kSpace, z, J, MatX());
  const auto ln_B = [](const VecX& at) -> VecX {
    return effective_rigidity(kSpace.decode(at)).array().log();
  };
  // rounding of logarithms
  EXPECT_TRUE(found.rigidity.isApprox(effective_rigidity(stiff_fabric()), 1e-14));
  MatX slopes(3, 3);
  for (int j = 0; j < 3; ++j) {
    const Vec3 step = 1e-5 * Vec3::Unit(j);
    slopes.col(j) = (ln_B(z + step) - ln_B(z - step)) / 2e-5;
  }
  const Vec3 variance = (slopes * found.covariance * slopes.transpose()).diagonal();
  EXPECT_LE((found.rigidity_log_sd - variance.cwiseSqrt()).norm(), 1e-8);  // of the differences
  EXPECT_GT(found.rigidity_log_sd.minCoeff(), 0);
}

TEST(Posterior, WhatNothingDecidesIsNotKnown) {
  MatX J = some_rows(7, 3);
  J.col(2).setZero();
  const Posterior found = laplace(kSpace, kSpace.encode(stiff_fabric()), J, MatX());
  EXPECT_TRUE(found.log_sd.array().isNaN().all());
  EXPECT_TRUE(found.direction_shares.array().isNaN().all());
  EXPECT_TRUE(found.rigidity_log_sd.array().isNaN().all());
  EXPECT_TRUE(found.rigidity.isApprox(effective_rigidity(stiff_fabric()), 1e-14));
}

}  // namespace
}  // namespace drape::test
