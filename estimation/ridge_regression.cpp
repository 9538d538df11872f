#include "estimation/ridge_regression.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace drape {

RidgeRegression::RidgeRegression(const MatX& features, const MatX& z)
    : inverse_count_(1. / static_cast<double>(features.rows())),
      mean_features_(features.colwise().mean()),
      mean_z_(z.colwise().mean()) {
  const MatX X = features.rowwise() - mean_features_.transpose();
  const MatX Z = z.rowwise() - mean_z_.transpose();
  MatX XtX = MatX::Zero(X.cols(), X.cols());
  XtX.selfadjointView<Eigen::Lower>().rankUpdate(X.transpose());
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(XtX);  // reads the lower half
  directions_ = eigen.eigenvectors();
  eigenvalues_ = eigen.eigenvalues().cwiseMax(0);  // but for rounding
  projected_.resize(X.cols(), Z.cols());
  for (Eigen::Index j = 0; j < Z.cols(); ++j)
    projected_.col(j) = directions_.transpose() * VecX(X.transpose() * Z.col(j));
}

VecX RidgeRegression::mean(const VecX& features, const VecX& penalties) const {
  const VecX along = directions_.transpose() * (features - mean_features_);
  VecX mean = mean_z_;
  for (Eigen::Index j = 0; j < mean.size(); ++j)
    mean[j] +=
        (along.array() * projected_.col(j).array() / (eigenvalues_.array() + penalties[j])).sum();
  return mean;
}

VecX RidgeRegression::error_factors(const VecX& features, const VecX& penalties) const {
  const VecX along = directions_.transpose() * (features - mean_features_);
  VecX factors(penalties.size());
  for (Eigen::Index j = 0; j < factors.size(); ++j)
    factors[j] = std::sqrt(1 + inverse_count_ +
                           (along.array().square() / (eigenvalues_.array() + penalties[j])).sum());
  return factors;
}

}  // namespace drape
