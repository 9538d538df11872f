#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "core/indefinite_factor.h"

namespace drape::test {
namespace {

SparseMatrix lower_of(const MatX& A) {
  SparseMatrix lower = MatX(A.triangularView<Eigen::Lower>()).sparseView();
  lower.makeCompressed();
  return lower;
}

TEST(IndefiniteFactor, SolvesAndCountsTheInertia) {
  MatX A(3, 3);
  A << 2, 1, 0.5, 1, -3, 0.2, 0.5, 0.2, 4;
  IndefiniteFactor factor;
  for (const double shift : {-5.0, 0.0, 5.0}) {
    const MatX B = A + shift * MatX::Identity(3, 3);
    const VecX values = Eigen::SelfAdjointEigenSolver<MatX>(B).eigenvalues();
    ASSERT_TRUE(factor.factorize(lower_of(B)));
    EXPECT_EQ(factor.negative_eigenvalues(), (values.array() < 0).count());
    const VecX b = Eigen::Vector3d(1, -2, 3);
    EXPECT_LE((B * factor.solve(b) - b).norm(), 1e-13);  // rounding
  }
}

TEST(IndefiniteFactor, RefusesWhatHasNoFactor) {
  IndefiniteFactor factor;
  MatX A = MatX::Ones(2, 2);
  A(1, 0) = A(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(factor.factorize(lower_of(A)));
}

}  // namespace
}  // namespace drape::test
