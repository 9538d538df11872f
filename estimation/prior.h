// What is known of a fabric before its picture is seen: a Gaussian over the unknowns of a fit.
#pragma once

#include <vector>

#include "estimation/parameter_space.h"
#include "estimation/tag.h"

namespace drape {

/// Mean and full covariance of z (see ParameterSpace).
struct Prior {
  VecX mean;
  MatX covariance;
};

/// Of ln of the areal density where a fabric was weighed. Assumed.
inline constexpr double kWeighingSd = 0.02;

/// Throws std::invalid_argument unless the sizes are those of z and the covariance is symmetric and
/// positive definite.
void validate(const Prior& prior, int size);

/// Every unknown by itself, log_sd about its value in `fabric`. Throws std::invalid_argument unless
/// log_sd > 0.
Prior prior_about(const ParameterSpace& space, const Fabric& fabric, double log_sd);

/// From structure and weight [kg/m^2] alone: bending as measured on 618 fabrics, the three k_b
/// correlated; stretch and shear over their ranges. Its centre is first_parameters, except for the
/// stretch. Throws like first_parameters.
Prior prior_from_weight(const std::vector<Parameter>& parameters, Structure structure,
                        double areal_density);

/// From the whole tag: mean and covariance of z over fabrics drawn from the tag model
/// (random_parameters). The weight is as certain as a weighing. Throws like first_parameters.
Prior prior_from_tag(const std::vector<Parameter>& parameters, const Tag& tag,
                     BendingThreshold threshold);

}  // namespace drape
