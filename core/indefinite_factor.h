// L D L^T of a symmetric matrix that need not be positive definite, with its inertia.
//
// Beyond a fold of a branch the Hessian of an equilibrium has negative eigenvalues; there
// Cholesky's factor (sparse_factor.h) does not exist. Without pivoting: fails where a pivot
// vanishes.
#pragma once

#include <Eigen/SparseCholesky>

#include "core/types.h"

namespace drape {

class IndefiniteFactor {
 public:
  /// lower: lower triangle, in a fill-reducing order already. False when a pivot vanishes or the
  /// matrix is not finite.
  bool factorize(const SparseMatrix& lower);

  /// After a successful factorisation: number of negative eigenvalues (Sylvester's law of inertia).
  int negative_eigenvalues() const;
  /// H x = b; requires a successful factorisation.
  VecX solve(const VecX& b) const;

 private:
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factor_;
  bool analysed_ = false;
};

}  // namespace drape
