#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/sparse_factor.h"
#include "tests/support/derivative_check.h"

namespace drape::test {
namespace {

std::vector<FactorBackend> backends() {
  if (default_factor_backend() == FactorBackend::eigen) return {FactorBackend::eigen};
  return {FactorBackend::cholmod, FactorBackend::eigen};
}

/// Lower triangle of the 5-point Laplacian of a square grid plus `shift`; eigenvalues 0 to 8 +
/// shift.
SparseMatrix grid_matrix(int side, double shift) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const int k = side * i + j;
      entries.emplace_back(k, k, 4 + shift);
      if (j + 1 < side) entries.emplace_back(k + 1, k, -1);
      if (i + 1 < side) entries.emplace_back(k + side, k, -1);
    }
  SparseMatrix lower(side * side, side * side);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

SparseFactor factor_for(const SparseMatrix& pattern, FactorBackend backend) {
  return SparseFactor(std::make_shared<const SymbolicFactor>(pattern, backend));
}

TEST(SparseFactor, SolvesAnyNumberOfColumns) {
  const SparseMatrix A = grid_matrix(15, 0.1);
  const MatX full = full_matrix(A);
  Random random(1);
  const MatX B = random_vector(3 * A.rows(), random).reshaped(A.rows(), 3);
  for (const FactorBackend backend : backends()) {
    SparseFactor factor = factor_for(A, backend);
    ASSERT_TRUE(factor.factorize(A));
    EXPECT_EQ(factor.size(), A.rows());
    // condition number 80, times rounding
    EXPECT_LE((full * factor.solve(B) - B).norm(), 1e-13 * B.norm()) << name(backend);
    EXPECT_LE((factor.solve(B.col(1)) - factor.solve(B).col(1)).norm(), 1e-13);
    VecX x = B.col(1);
    factor.solve_in_place(x);
    EXPECT_LE((factor.solve(B).col(1) - x).norm(), 1e-13);
  }
}

/// Panels of all widths: a dense block, bordered blocks, and single columns.
TEST(SparseFactor, SolvesInPlaceWithAllShapesOfSupernodes) {
  for (const int dense : {1, 2, 3, 4, 5, 7, 13, 40}) {
    const int n = dense + 60;
    MatX A = MatX::Identity(n, n) * 50;
    Random random(1);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j)
        if (i >= 60 || i - j <= 1 || (i % 7 == 0 && i - j < 7)) A(i, j) = random.uniform(-1, 1);
    const SparseMatrix lower = MatX(A.triangularView<Eigen::Lower>()).sparseView();
    const MatX full = full_matrix(lower);
    const VecX b = random_vector(n, random);
    for (const FactorBackend backend : backends()) {
      SparseFactor factor = factor_for(lower, backend);
      VecX x = b;
      EXPECT_THROW(factor.solve_in_place(x), std::logic_error);
      ASSERT_TRUE(factor.factorize(lower));
      factor.solve_in_place(x);
      EXPECT_LE((full * x - b).norm(), 1e-13 * b.norm()) << dense << ", " << name(backend);
      EXPECT_EQ(x.size(), n);
    }
  }
}

TEST(SparseFactor, OneAnalysisServesManyMatrices) {
  const SparseMatrix pattern = grid_matrix(10, 0);
  for (const FactorBackend backend : backends()) {
    const auto symbolic = std::make_shared<const SymbolicFactor>(pattern, backend);
    EXPECT_GE(symbolic->nonzeros(), static_cast<double>(pattern.nonZeros() - pattern.rows()));
    SparseFactor first(symbolic), second(symbolic);
    ASSERT_TRUE(first.factorize(grid_matrix(10, 1)));
    ASSERT_TRUE(second.factorize(grid_matrix(10, 5)));
    const VecX b = VecX::Ones(100);
    EXPECT_LE((full_matrix(grid_matrix(10, 1)) * first.solve(b) - b).norm(), 1e-12);
    EXPECT_LE((full_matrix(grid_matrix(10, 5)) * second.solve(b) - b).norm(), 1e-12);
  }
}

TEST(SparseFactor, RefusesIndefiniteAndNonFiniteMatricesAndRecovers) {
  for (const FactorBackend backend : backends()) {
    SparseFactor factor = factor_for(grid_matrix(10, 0), backend);
    EXPECT_THROW(factor.solve(VecX::Ones(100)), std::logic_error);
    EXPECT_FALSE(factor.factorize(grid_matrix(10, -1))) << name(backend);
    EXPECT_THROW(factor.solve(VecX::Ones(100)), std::logic_error);
    SparseMatrix bad = grid_matrix(10, 1);
    bad.coeffRef(50, 50) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(factor.factorize(bad)) << name(backend);
    EXPECT_TRUE(factor.factorize(grid_matrix(10, 1)));
    EXPECT_TRUE(factor.solve(VecX::Ones(100)).allFinite());
  }
}

TEST(SparseFactor, InertiaCountsNegativeEigenvalues) {
  for (const double shift : {0.5, -0.3, -2.02, -3.9, -9.0}) {
    const SparseMatrix A = grid_matrix(8, shift);
    const VecX eigenvalues = Eigen::SelfAdjointEigenSolver<MatX>(full_matrix(A)).eigenvalues();
    EXPECT_EQ(negative_eigenvalues(A), (eigenvalues.array() < 0).count()) << shift;
  }
  SparseMatrix zero(1, 1);
  zero.insert(0, 0) = 0;
  EXPECT_EQ(negative_eigenvalues(zero), -1);
}

TEST(SparseFactor, SmallestEigenvalue) {
  const SparseMatrix A = grid_matrix(8, 0.01);
  const double smallest = Eigen::SelfAdjointEigenSolver<MatX>(full_matrix(A)).eigenvalues()[0];
  for (const FactorBackend backend : backends()) {
    SparseFactor factor = factor_for(A, backend);
    ASSERT_TRUE(factor.factorize(A));
    EXPECT_NEAR(smallest_eigenvalue(factor), smallest, 1e-10);  // inverse iteration has converged
  }
}

TEST(SparseFactor, NamesGoThereAndBack) {
  for (const FactorBackend backend : backends())
    EXPECT_EQ(factor_backend_from_name(name(backend)), backend);
  EXPECT_THROW(factor_backend_from_name("pardiso"), std::invalid_argument);
#ifndef DRAPE_WITH_CHOLMOD
  EXPECT_THROW(factor_backend_from_name("cholmod"), std::invalid_argument);
#endif
}

/// Without core/blas_call.h, Debian's serial OpenBLAS ends this in wrong factors or a crash.
TEST(SparseFactor, ThreadsDoNotDisturbOneAnother) {
  constexpr int kTimes = 1000;
  const std::vector<SparseMatrix> matrices{grid_matrix(30, 0.1), grid_matrix(31, 0.2)};
  const auto solved = [](SparseFactor& factor, const SparseMatrix& A) -> MatX {
    return factor.factorize(A) ? factor.solve(MatX::Ones(A.rows(), 4)) : MatX();
  };
  for (const FactorBackend backend : backends()) {
    std::vector<MatX> alone;
    for (const SparseMatrix& A : matrices) {
      SparseFactor factor = factor_for(A, backend);
      alone.push_back(solved(factor, A));
    }
    std::vector<int> wrong(matrices.size());
    std::vector<std::thread> threads;
    for (size_t i = 0; i < matrices.size(); ++i)
      threads.emplace_back([&, i] {
        SparseFactor factor = factor_for(matrices[i], backend);
        for (int k = 0; k < kTimes; ++k) wrong[i] += solved(factor, matrices[i]) != alone[i];
      });
    for (std::thread& thread : threads) thread.join();
    for (const int count : wrong) EXPECT_EQ(count, 0) << name(backend);
  }
}

}  // namespace
}  // namespace drape::test
