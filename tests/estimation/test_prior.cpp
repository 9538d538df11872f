#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

#include "core/random.h"
#include "estimation/bending_rigidity.h"
#include "estimation/prior.h"
#include "estimation/tag_model.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

const std::vector<Parameter> kBending{Parameter::k_bu, Parameter::k_bv, Parameter::k_bh};

TEST(Prior, AboutAFabric) {
  const ParameterSpace space{{Parameter::k_h, Parameter::t_bu}, stiff_fabric()};
  const Prior prior = prior_about(space, medium_fabric(), 0.5);
  EXPECT_EQ(prior.mean, Vec2(std::log(50), 0.35));
  EXPECT_EQ(prior.covariance, 0.25 * Eigen::Matrix2d::Identity());
  EXPECT_NO_THROW(validate(prior, 2));
  EXPECT_THROW(prior_about(space, medium_fabric(), 0), std::invalid_argument);
}

TEST(Prior, FromWeightHasAllParameters) {
  const std::vector<Parameter> all(all_parameters().begin(), all_parameters().end());
  for (const Structure structure : {Structure::woven, Structure::knit, Structure::other}) {
    const Prior prior = prior_from_weight(all, structure, 0.2);
    EXPECT_NO_THROW(validate(prior, kParameterCount));
    const Fabric first = first_parameters(structure, 0.2);
    EXPECT_EQ(prior.mean[static_cast<int>(Parameter::k_bh)], std::log(first.k_bh));
    EXPECT_EQ(prior.mean[static_cast<int>(Parameter::t_bu)], first.t_bu);
  }
  EXPECT_THROW(prior_from_weight(all, Structure::woven, 0), std::invalid_argument);
}

TEST(Prior, BendingFromWeightScattersAsMeasured) {
  const Prior prior = prior_from_weight(kBending, Structure::woven, 0.2);
  const Mat3 factor = prior.covariance.llt().matrixL();
  Random random(1);
  constexpr int kFabrics = 20000;
  Eigen::Matrix3Xd ln_B(3, kFabrics);
  for (int i = 0; i < kFabrics; ++i) {
    Vec3 normal;
    for (int k = 0; k < 3; ++k)  // Box and Muller
      normal[k] = std::sqrt(-2 * std::log(1 - random.uniform(0, 1))) *
                  std::cos(2 * M_PI * random.uniform(0, 1));
    const Vec3 k_b = (prior.mean + factor * normal).array().exp();
    Fabric fabric;
    fabric.k_bu = k_b[0];
    fabric.k_bv = k_b[1];
    fabric.k_bh = k_b[2];
    ln_B.col(i) = effective_rigidity(fabric).array().log();
  }
  ln_B.colwise() -= Vec3(ln_B.rowwise().mean());
  const Mat3 C = ln_B * ln_B.transpose() / kFabrics;
  // what was measured, see prior.cpp; the two numbers of threads and bias leave the fit this rough
  EXPECT_NEAR(std::sqrt(C(0, 0)), 0.89, 0.05);
  EXPECT_NEAR(std::sqrt(C(1, 1)), 0.89, 0.05);
  EXPECT_NEAR(std::sqrt(C(2, 2)), 0.82, 0.08);
  EXPECT_NEAR(C(0, 1) / C(0, 0), 0.72, 0.05);
  EXPECT_NEAR(C(0, 2) / std::sqrt(C(0, 0) * C(2, 2)), 0.77, 0.13);
}

TEST(Prior, FromATagIsTheTagModel) {
  const std::vector<Parameter> all(all_parameters().begin(), all_parameters().end());
  Tag tag{"x", "Woven", "", "Twill", composition_from_text("Cotton 97; Spandex / Elastane 3"), 0.2};
  for (const BendingThreshold threshold : {BendingThreshold::printed, BendingThreshold::radius}) {
    const Prior prior = prior_from_tag(all, tag, threshold);
    EXPECT_NO_THROW(validate(prior, kParameterCount));
    EXPECT_NEAR(prior.mean[0], std::log(0.2), 1e-12);  // rounding of a mean of 4000
    const auto ranges = parameter_ranges(tag, threshold);
    for (const Parameter p : {Parameter::k_u, Parameter::k_h}) {
      const auto i = static_cast<int>(p);
      const ParameterRange& range = ranges[static_cast<size_t>(p)];
      // normal in the logarithm: the percentiles of 4000 draws are good to 4 % of the deviation
      const double sd = std::sqrt(prior.covariance(i, i));
      EXPECT_NEAR(prior.mean[i], std::log(range.median), 0.1 * sd);
      EXPECT_NEAR(2 * 1.645 * sd, std::log(range.high / range.low), 0.2 * sd);
    }
  }
  tag.category = "none";
  EXPECT_THROW(prior_from_tag(all, tag, BendingThreshold::radius), std::invalid_argument);
}

TEST(Prior, BadPriorsAreRefused) {
  const Prior good = prior_from_weight(kBending, Structure::knit, 0.2);
  EXPECT_NO_THROW(validate(good, 3));
  EXPECT_THROW(validate(good, 2), std::invalid_argument);
  Prior bad = good;
  bad.covariance(0, 1) += 0.1;  // not symmetric
  EXPECT_THROW(validate(bad, 3), std::invalid_argument);
  bad = good;
  bad.covariance(0, 1) = bad.covariance(1, 0) = 2 * good.covariance(0, 0);  // not positive
  EXPECT_THROW(validate(bad, 3), std::invalid_argument);
  bad = good;
  bad.mean[1] = std::nan("");
  EXPECT_THROW(validate(bad, 3), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
