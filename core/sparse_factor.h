// Sparse Cholesky factorisation of Hessians: analysed once a mesh, factored many times.
//
// Two back ends: CHOLMOD's supernodal factorisation (fast; its supernodal module is GPL) and
// Eigen's simplicial LDL^T (reference, and what is left when built without CHOLMOD). Matrices come
// in a fill-reducing order already and hold their lower triangle.
#pragma once

#include <memory>
#include <string_view>

#include "core/types.h"

namespace drape {

enum class FactorBackend { cholmod, eigen };

/// CHOLMOD where it was built in, else Eigen.
FactorBackend default_factor_backend();
std::string_view name(FactorBackend backend);
/// Throws std::invalid_argument listing the back ends that were built in.
FactorBackend factor_backend_from_name(std::string_view name);

/// The structure of the factors of all matrices with one sparsity. Immutable, shared by threads.
class SymbolicFactor {
 public:
  SymbolicFactor(const SparseMatrix& pattern, FactorBackend backend);
  ~SymbolicFactor();
  SymbolicFactor(const SymbolicFactor&) = delete;
  SymbolicFactor& operator=(const SymbolicFactor&) = delete;

  FactorBackend backend() const { return backend_; }
  Eigen::Index size() const { return size_; }  ///< number of unknowns
  double nonzeros() const;                     ///< entries of the factor

 private:
  friend class SparseFactor;
  struct Cholmod;
  FactorBackend backend_;
  Eigen::Index size_;
  double eigen_nonzeros_ = 0;
  std::unique_ptr<Cholmod> cholmod_;
};

/// A numeric factorisation. One object may be used by one thread at a time.
class SparseFactor {
 public:
  explicit SparseFactor(std::shared_ptr<const SymbolicFactor> symbolic);
  ~SparseFactor();
  SparseFactor(const SparseFactor&) = delete;
  SparseFactor& operator=(const SparseFactor&) = delete;

  /// Cholesky factorisation of a matrix with the analysed sparsity. Returns false, and leaves no
  /// usable factor, when the matrix is not positive definite or not finite. Throws
  /// std::runtime_error when memory runs out.
  bool factorize(const SparseMatrix& lower);

  Eigen::Index size() const { return symbolic_->size(); }

  /// Solves H X = B, any number of columns. Requires a successful factorisation.
  MatX solve(const MatX& right_hand_sides) const;

  /// x <- H^-1 x, without allocating (CHOLMOD; a factor is solved with many times). Requires a
  /// successful factorisation.
  void solve_in_place(VecX& x) const;

 private:
  struct Numeric;
  std::shared_ptr<const SymbolicFactor> symbolic_;
  std::unique_ptr<Numeric> numeric_;
};

/// Number of negative eigenvalues of a symmetric matrix (lower triangle), from the signs of the
/// pivots of LDL^T (Sylvester's law of inertia); -1 when a pivot vanishes.
int negative_eigenvalues(const SparseMatrix& lower);

/// Smallest eigenvalue of a factored positive definite matrix, by inverse iteration [its unit].
double smallest_eigenvalue(const SparseFactor& factor);

}  // namespace drape
