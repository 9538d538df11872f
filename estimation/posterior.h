// The posterior about its maximum in Laplace's approximation: how well a fit knows what it found,
// and what of that it owes to the pictures.
//
// With J the Jacobian of the whitened residuals at the maximum (drape_objective.h), the posterior
// of u is Gaussian with covariance (J^T J)^-1, its prior with J restricted to the rows of the
// priors. The information of the pictures about the fabric, nuisances integrated out, is
// D = S^-1 - C^-1 with S and C the posterior and prior covariances of z. Solutions of
// D d = lambda C^-1 d are the directions in which prior and pictures add up independently; the
// pictures' share of what is known along d is lambda / (1 + lambda).
#pragma once

#include "estimation/parameter_space.h"

namespace drape {

struct Posterior {
  VecX log_sd;      ///< of every entry of z; NaN, with all below, where J^T J is singular
  MatX covariance;  ///< S, of z
  /// 1 - (posterior over prior variance) of every entry of z: 0 is prior alone, 1 picture alone.
  VecX picture_share;
  MatX directions;        ///< columns d, scaled to one prior standard deviation, best seen first
  VecX direction_shares;  ///< the pictures' share along each
  Vec3 rigidity;          ///< effective (B_u, B_v, B_45) [N m]
  Vec3 rigidity_log_sd;   ///< by the delta method; what is held counts as known
};

/// Prior standard deviation of an entry of z that shares are told against where there is no prior.
inline constexpr double kReferenceLogSd = 1;

/// jacobian: residuals x unknowns of a fit, z first, rows of the priors included.
/// prior_covariance: of z, empty where there is none (then shares are against kReferenceLogSd).
Posterior laplace(const ParameterSpace& space, const VecX& z, const MatX& jacobian,
                  const MatX& prior_covariance);

}  // namespace drape
