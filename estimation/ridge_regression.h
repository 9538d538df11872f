// Linear regression of several quantities with a penalty on the squares of the coefficients (Hoerl
// and Kennard 1970), for every penalty at once through one eigen-decomposition.
//
// With x and z centred and X, Z all of them: coefficients (X^T X + penalty)^-1 X^T Z; the intercept
// has no penalty. As random effects: coefficients of variance s^2 / penalty, errors of variance
// s^2; then s^2 h is the variance of a predicted mean, h = 1/n + x^T (X^T X + penalty)^-1 x.
#pragma once

#include "core/types.h"

namespace drape {

class RidgeRegression {
 public:
  /// n x p and n x q, an observation a row.
  RidgeRegression(const MatX& features, const MatX& z);
  /// The q predicted means at p features, each quantity with its own penalty > 0.
  VecX mean(const VecX& features, const VecX& penalties) const;
  /// sqrt(1 + h) of each quantity: the standard deviation of an error of prediction over s.
  VecX error_factors(const VecX& features, const VecX& penalties) const;

 private:
  double inverse_count_;
  VecX mean_features_, mean_z_;
  MatX directions_;   ///< eigenvectors of X^T X
  VecX eigenvalues_;  ///< of X^T X
  MatX projected_;    ///< X^T Z along the eigenvectors
};

}  // namespace drape
