// What a tag tells, learned from fabrics whose parameters are known: ridge regression of z
// (parameter_space.h) on the features of the tag (tag_features.h).
//
// All coefficients of a parameter are random effects of one variance (ridge_regression.h): a type
// of few fabrics is drawn towards its subcategory and category, and a type or fibre that no fabric
// had gets their value. The penalty is the one whose squared errors are least in cross-validation.
//
// Covariance of an error of prediction: C_ab sqrt((1 + h_a) (1 + h_b)). C is estimated from the
// errors of cross-validation, each divided by its own sqrt(1 + h), partly by structure: knits
// scatter otherwise than wovens. What no fabric told, such as the whole effect of a type that none
// had, is in h of the tag asked about.
#pragma once

#include <array>
#include <vector>

#include "estimation/prior.h"
#include "estimation/ridge_regression.h"

namespace drape {

class TagRegression {
 public:
  /// How a parameter was predicted in cross-validation, each fabric from others.
  struct Validation {
    bool varies;       ///< whether it differs between the fabrics; the rest is 0 if not
    double r_squared;  ///< 1 - squared errors over squared deviations from the mean
    double error_sd;   ///< root mean square of the errors of z
    double coverage;   ///< share of the fabrics within their interval of 90 %
  };

  /// Fewer fabrics are not enough to fit and validate.
  static constexpr int kFewest = 20;

  /// Ten folds, by a fixed shuffle of the places in the list: another order of the fabrics changes
  /// the result as other folds do, no more. Throws std::invalid_argument for fewer fabrics than
  /// kFewest, and naming the fabric for a parameter without a finite z and for what tag_features
  /// refuses.
  explicit TagRegression(const std::vector<TaggedFabric>& fabrics);

  /// Mean and covariance of z. The weight is as certain as a weighing, and no parameter more so;
  /// one that did not vary scatters as in prior_from_weight. Throws like tag_features.
  Prior predict(const std::vector<Parameter>& parameters, const Tag& tag) const;

  int fabrics() const { return count_; }
  const Validation& validation(Parameter p) const { return validation_[static_cast<size_t>(p)]; }
  /// The mean share of the parameters that vary, without the weight; NaN if none does.
  double coverage() const;

 private:
  TagRegression(const MatX& features, const MatX& z, const std::vector<TaggedFabric>& fabrics);

  int count_;
  RidgeRegression ridge_;
  VecX penalties_;
  std::array<MatX, 3> scatter_;  ///< C by structure
  std::array<Validation, kParameterCount> validation_{};
};

}  // namespace drape
