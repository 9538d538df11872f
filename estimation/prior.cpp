#include "estimation/prior.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "estimation/tag_model.h"

namespace drape {
namespace {

/// Below it nothing was scattered: what is left is rounding.
constexpr double kLeastVariance = 1e-20;

/// ln k_b about its mean given the weight. Fitted: with these, the logarithms of (B_u, B_v, B_45) =
/// 4 M k_b scatter about their regression on the weight as they do over the distinct rows of the
/// 618 of Feng et al. 2022 (doi 10.1145/3550454.3555464): standard deviations 0.89 and 0.82
/// (bias), correlations 0.72 (weft, warp) and 0.77 (with bias), weft and warp taken alike.
constexpr double kSdAlongThread = 1.3, kSdBias = 0.9, kCorrelationOfThreads = 0.5;

bool is_thread_bending(Parameter p) { return p == Parameter::k_bu || p == Parameter::k_bv; }

/// Mean and standard deviation of a logarithm that is below `low` and above `high` in one case of
/// twenty each.
struct LogRange {
  LogRange(double low, double high)
      : mean(0.5 * std::log(low * high)), sd(std::log(high / low) / (2 * 1.645)) {}
  double mean, sd;
};

LogRange stretch_range(Structure structure) {
  switch (structure) {
    case Structure::woven:
      return {1e3, 3e4};  // Measured, the range of wovens, N/m.
    case Structure::knit:
      return {1e1, 2e2};  // Measured, the range of knits.
    case Structure::other:
      return {1e1, 3e4};  // Assumed: anywhere within both.
  }
  throw std::logic_error("a structure without a range of stretch");
}

/// Standard deviation of ln k_h.
double shear_sd(Structure structure) {
  switch (structure) {
    case Structure::woven:
      return 0.85;  // Measured on three wovens, 19, 53 and 105 N/m (Wang et al. 2011).
    case Structure::knit:
      return 0.5;  // Measured on five knits, 18 to 83 N/m (the same).
    case Structure::other:
      return 1.5;  // Assumed.
  }
  throw std::logic_error("a structure without a range of shear");
}

double sd_from_weight(Parameter p, Structure structure) {
  switch (p) {
    case Parameter::areal_density:
      return kWeighingSd;
    case Parameter::k_u:
    case Parameter::k_v:
      return stretch_range(structure).sd;
    case Parameter::k_h:
      return shear_sd(structure);
    case Parameter::k_bu:
    case Parameter::k_bv:
      return kSdAlongThread;
    case Parameter::k_bh:
      return kSdBias;
    case Parameter::s_bu:
    case Parameter::s_bv:
    case Parameter::s_bh:
      return 0.5;  // Assumed: over 99 % of the 618 soften with curvature, how much is not known.
    case Parameter::t_bu:
    case Parameter::t_bv:
    case Parameter::t_bh:
      return 0.2;  // Assumed, of t_b itself: the source fixes 0.3.
  }
  throw std::logic_error("a parameter without a prior");
}

}  // namespace

void validate(const Prior& prior, int size) {
  const MatX& C = prior.covariance;
  if (prior.mean.size() != size || C.rows() != size || C.cols() != size)
    throw std::invalid_argument("the prior is over " + std::to_string(prior.mean.size()) +
                                " unknowns, its covariance " + std::to_string(C.rows()) + " x " +
                                std::to_string(C.cols()) + "; the fit has " + std::to_string(size));
  if (!prior.mean.allFinite() || !C.allFinite() || !C.isApprox(C.transpose()) ||
      C.llt().info() != Eigen::Success)
    throw std::invalid_argument(
        "the prior's mean must be finite and its covariance symmetric and positive definite");
}

Prior prior_about(const ParameterSpace& space, const Fabric& fabric, double log_sd) {
  if (!(log_sd > 0))
    throw std::invalid_argument("the standard deviation of a prior is " + std::to_string(log_sd) +
                                "; must be > 0");
  return {space.encode(fabric), log_sd * log_sd * MatX::Identity(space.size(), space.size())};
}

Prior prior_from_weight(const std::vector<Parameter>& parameters, Structure structure,
                        double areal_density) {
  const ParameterSpace space{parameters, first_parameters(structure, areal_density)};
  Prior prior{space.encode(space.reference), MatX::Zero(space.size(), space.size())};
  for (int i = 0; i < space.size(); ++i) {
    const Parameter p = parameters[static_cast<size_t>(i)];
    if (p == Parameter::k_u || p == Parameter::k_v) prior.mean[i] = stretch_range(structure).mean;
    prior.covariance(i, i) = std::pow(sd_from_weight(p, structure), 2);
    for (int j = 0; j < i; ++j)
      if (is_thread_bending(p) && is_thread_bending(parameters[static_cast<size_t>(j)]))
        prior.covariance(i, j) = prior.covariance(j, i) =
            kCorrelationOfThreads * kSdAlongThread * kSdAlongThread;
  }
  return prior;
}

Prior prior_from_tag(const std::vector<Parameter>& parameters, const Tag& tag,
                     BendingThreshold threshold) {
  const ParameterSpace space{parameters, first_parameters(tag)};
  const std::vector<Fabric> drawn = drawn_fabrics(tag, threshold);
  const auto count = static_cast<Eigen::Index>(drawn.size());
  MatX z(space.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) z.col(i) = space.encode(drawn[static_cast<size_t>(i)]);
  Prior prior{z.rowwise().mean(), {}};
  z.colwise() -= prior.mean;
  prior.covariance = z * z.transpose() / static_cast<double>(count - 1);
  // what the model does not scatter (the weight; softening in the reading "printed")
  for (int i = 0; i < space.size(); ++i)
    if (prior.covariance(i, i) < kLeastVariance)
      prior.covariance(i, i) = std::pow(
          sd_from_weight(parameters[static_cast<size_t>(i)], structure_from_category(tag.category)),
          2);
  return prior;
}

}  // namespace drape
