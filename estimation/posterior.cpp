#include "estimation/posterior.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "estimation/bending_rigidity.h"

namespace drape {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// d ln(B_u, B_v, B_45) / dz.
Eigen::Matrix3Xd rigidity_slopes(const ParameterSpace& space, const VecX& z) {
  const Fabric fabric = space.decode(z);
  const VecX dp_dz = space.derivative(z);
  Eigen::Matrix3Xd slopes = Eigen::Matrix3Xd::Zero(3, space.size());
  const Vec3 B = effective_rigidity(fabric);
  for (int i = 0; i < space.size(); ++i) {
    Fabric unit = fabric;  // B is linear in k_b
    unit.k_bu = unit.k_bv = unit.k_bh = 0;
    const Parameter p = space.parameters[static_cast<size_t>(i)];
    if (p != Parameter::k_bu && p != Parameter::k_bv && p != Parameter::k_bh) continue;
    unit[p] = dp_dz[i];
    slopes.col(i) = effective_rigidity(unit).cwiseQuotient(B);
  }
  return slopes;
}

}  // namespace

Posterior laplace(const ParameterSpace& space, const VecX& z, const MatX& jacobian,
                  const MatX& prior_covariance) {
  const int p = space.size();
  Posterior result;
  result.rigidity = effective_rigidity(space.decode(z));
  result.log_sd = result.picture_share = result.direction_shares = VecX::Constant(p, kNaN);
  result.covariance = result.directions = MatX::Constant(p, p, kNaN);
  result.rigidity_log_sd.setConstant(kNaN);
  const Eigen::CompleteOrthogonalDecomposition<MatX> qr(jacobian.transpose() * jacobian);
  if (qr.rank() < jacobian.cols()) return result;

  const MatX inverse = qr.pseudoInverse().topLeftCorner(p, p);
  const MatX S = 0.5 * (inverse + inverse.transpose());
  result.covariance = S;
  result.log_sd = S.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::Matrix3Xd slopes = rigidity_slopes(space, z);
  result.rigidity_log_sd = (slopes * S * slopes.transpose()).diagonal().cwiseMax(0).cwiseSqrt();

  // S d = (1 - share) C d, and without a prior S = R (1 / share - 1) with R the reference
  const bool has_prior = prior_covariance.size() > 0;
  const MatX C =
      has_prior ? prior_covariance : MatX(kReferenceLogSd * kReferenceLogSd * MatX::Identity(p, p));
  const auto share_of = [has_prior](double variance_ratio) {
    return has_prior ? 1 - variance_ratio : 1 / (1 + variance_ratio);
  };
  result.picture_share = S.diagonal().cwiseQuotient(C.diagonal()).unaryExpr(share_of);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatX> modes(S, C);  // ratios increase
  result.direction_shares = modes.eigenvalues().unaryExpr(share_of);
  result.directions = C * modes.eigenvectors();
  return result;
}

}  // namespace drape
