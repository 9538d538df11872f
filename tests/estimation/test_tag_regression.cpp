// On fabrics made here by laws that are known, and on those of the tag model.
#include "estimation/tag_regression.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/random.h"
#include "estimation/fabric_types.h"
#include "estimation/random_tags.h"
#include "estimation/tag_model.h"

namespace drape::test {
namespace {

const std::vector<Parameter> kAll(all_parameters().begin(), all_parameters().end());

double cotton(const Tag& tag) {
  for (const Fibre& fibre : tag.composition)
    if (fibre.name == "Cotton") return fibre.percent / 100;
  return 0;
}

/// ln k_h by a linear law.
double law(const Tag& tag) {
  return 3 + 0.8 * std::log(tag.areal_density) + 1.5 * cotton(tag) +
         (tag.category == "Woven" ? 1 : 0);
}

/// Fabrics whose ln k_h is that law and a normal error; k_bu and k_bv share theirs half.
std::vector<TaggedFabric> made_fabrics(int count, std::uint64_t seed, double sd) {
  Random random(seed);
  std::vector<TaggedFabric> fabrics;
  for (const Tag& tag : random_tags(count, seed)) {
    Fabric fabric;
    fabric.areal_density = tag.areal_density;
    fabric.k_h = std::exp(law(tag) + sd * random.normal());
    const double shared = random.normal();
    fabric.k_bu = 1e-6 * std::exp(sd * (shared + random.normal()));
    fabric.k_bv = 1e-6 * std::exp(sd * (shared + random.normal()));
    fabrics.push_back({tag, fabric});
  }
  return fabrics;
}

std::vector<TaggedFabric> model_fabrics(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<TaggedFabric> fabrics;
  for (const Tag& tag : random_tags(count, seed))
    fabrics.push_back({tag, random_parameters(tag, BendingThreshold::printed, random)});
  return fabrics;
}

/// That many fabrics of a type; ln k_h scatters about its own.
void add(std::vector<TaggedFabric>& fabrics, int count, const std::string& type, double ln_k_h,
         Random& random) {
  const FabricType& of = *find_type(type);
  for (int i = 0; i < count; ++i) {
    Fabric fabric;
    fabric.k_h = std::exp(ln_k_h + 0.5 * random.normal());
    fabrics.push_back(
        {{"x", std::string(of.category), std::string(of.subcategory), type, {}, 0.2}, fabric});
  }
}

Tag tag_of_type(const std::string& type) {
  const FabricType& of = *find_type(type);
  return {"x", std::string(of.category), std::string(of.subcategory), type, {}, 0.2};
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(TagRegression, RecoversALinearLaw) {
  constexpr double kSd = 0.3;
  const TagRegression regression(made_fabrics(2000, 1, kSd));
  double squares = 0, of_law = 0, mean_law = 0;
  const std::vector<Tag> tags = random_tags(500, 2);
  for (const Tag& tag : tags) mean_law += law(tag) / 500;
  for (const Tag& tag : tags) {
    squares += std::pow(regression.predict({Parameter::k_h}, tag).mean[0] - law(tag), 2) / 500;
    of_law += std::pow(law(tag) - mean_law, 2) / 500;
  }
  // about 110 coefficients from 2000 errors: sd sqrt(110 / 2000) without a penalty
  EXPECT_LT(std::sqrt(squares), 0.23 * kSd);
  const TagRegression::Validation& validation = regression.validation(Parameter::k_h);
  EXPECT_NEAR(validation.error_sd, kSd, 0.1 * kSd);  // that and four standard errors
  EXPECT_NEAR(validation.r_squared, of_law / (of_law + kSd * kSd), 0.03);
  // nothing to learn: the mean is the best, but for the choice of the penalty
  EXPECT_NEAR(regression.validation(Parameter::k_bu).r_squared, 0, 0.01);
}

TEST(TagRegression, DrawsARareTypeToItsKind) {
  const auto fitted = [](int ottomans) {
    Random random(3);
    std::vector<TaggedFabric> fabrics;
    for (const char* type : {"Poplin", "Voile", "Canvas", "Plain"})
      add(fabrics, 50, type, random.uniform(3.8, 4.2), random);
    for (const char* type : {"Twill", "Denim"}) add(fabrics, 50, type, 5, random);
    for (const char* type : {"Jersey", "Rib"}) add(fabrics, 50, type, 2, random);
    add(fabrics, ottomans, "Ottoman", 6, random);
    return TagRegression(fabrics);
  };
  const auto said = [](const TagRegression& regression, const char* type) {
    const Prior prior = regression.predict({Parameter::k_h}, tag_of_type(type));
    return std::pair(prior.mean[0], std::sqrt(prior.covariance(0, 0)));
  };
  // all Ottomans are plain weaves, whose ln k_h is about 4; those here have 6
  const auto none = said(fitted(0), "Ottoman"), one = said(fitted(1), "Ottoman"),
             many = said(fitted(100), "Ottoman");
  EXPECT_NEAR(none.first, 4, 0.25);
  EXPECT_GT(one.first, none.first + 0.2);
  EXPECT_LT(one.first, 5.8);
  EXPECT_NEAR(many.first, 6, 0.15);
  // what is not known of a type that no fabric had: its whole effect
  EXPECT_GT(none.second, 1.1 * said(fitted(0), "Poplin").second);
  EXPECT_GT(one.second, 1.05 * many.second);
}

TEST(TagRegression, IntervalsHoldNineOfTenOfOtherFabrics) {
  const TagRegression regression(made_fabrics(400, 4, 0.5));
  const std::vector<Parameter> bending{Parameter::k_bu, Parameter::k_bv};
  const std::vector<TaggedFabric> others = made_fabrics(1000, 5, 0.5);
  int inside = 0;
  double mahalanobis = 0;
  for (const TaggedFabric& other : others) {
    const Prior prior = regression.predict({Parameter::k_h}, other.tag);
    const double miss = std::log(other.fabric.k_h) - prior.mean[0];
    inside += std::abs(miss) <= 1.645 * std::sqrt(prior.covariance(0, 0));
    const Prior both = regression.predict(bending, other.tag);
    const VecX misses = ParameterSpace{bending, {}}.encode(other.fabric) - both.mean;
    mahalanobis += misses.dot(both.covariance.llt().solve(misses)) / 1000;
    EXPECT_NEAR(both.covariance(0, 1) / both.covariance(0, 0), 0.5, 0.15);
  }
  // binomial, three standard deviations of .0095; the variance from 400 errors adds .01
  EXPECT_NEAR(inside / 1000., 0.9, 0.04);
  EXPECT_NEAR(regression.validation(Parameter::k_h).coverage, 0.9, 0.05);  // of 400
  EXPECT_NEAR(regression.coverage(), 0.9, 0.05);
  EXPECT_NEAR(mahalanobis, 2, 0.35);  // chi^2 of 2: .06, and 7 % of each variance of 400 errors
}

TEST(TagRegression, SaysWhatStructuresScatter) {
  std::vector<TaggedFabric> fabrics;
  Random random(6);
  for (int i = 0; i < 400; ++i) {
    const bool knit = i % 2 == 0;
    fabrics.push_back({tag_of_type(knit ? "Jersey" : "Twill"), {}});
    fabrics.back().fabric.k_h = std::exp((knit ? 0.4 : 1.2) * random.normal());
  }
  const TagRegression regression(fabrics);
  const auto sd = [&](const char* type) {
    return std::sqrt(regression.predict({Parameter::k_h}, tag_of_type(type)).covariance(0, 0));
  };
  // 30 fabrics that scatter as all: sqrt((200 * .16 + 30 * .8) / 230) and likewise
  EXPECT_NEAR(sd("Jersey"), 0.49, 0.06);
  EXPECT_NEAR(sd("Twill"), 1.16, 0.14);
}

TEST(TagRegression, CovarianceIsPositiveDefiniteWhateverTheFabrics) {
  std::vector<TaggedFabric> fabrics = made_fabrics(30, 7, 0.5);
  for (TaggedFabric& tagged : fabrics) tagged.fabric.k_bh = tagged.fabric.k_bv = tagged.fabric.k_bu;
  const TagRegression regression(fabrics);
  const Tag& tag = fabrics.front().tag;
  const Prior prior = regression.predict(kAll, tag);
  EXPECT_NO_THROW(validate(prior, kParameterCount));

  const auto at = [](Parameter p) { return static_cast<int>(p); };
  EXPECT_FALSE(regression.validation(Parameter::k_u).varies);
  EXPECT_TRUE(regression.validation(Parameter::k_bh).varies);
  EXPECT_NEAR(prior.mean[at(Parameter::k_u)], std::log(Fabric{}.k_u), 1e-12);  // rounding
  const Prior assumed =
      prior_from_weight(kAll, structure_from_category(tag.category), tag.areal_density);
  for (const Parameter p : {Parameter::areal_density, Parameter::k_u, Parameter::t_bu})
    EXPECT_EQ(prior.covariance(at(p), at(p)), assumed.covariance(at(p), at(p)));
  EXPECT_EQ(prior.mean[0], std::log(tag.areal_density));

  // the parameters of a prior are as asked for, in that order
  const Prior some = regression.predict({Parameter::k_bv, Parameter::k_h}, tag);
  EXPECT_EQ(some.mean[1], prior.mean[at(Parameter::k_h)]);
  EXPECT_EQ(some.covariance(0, 1), prior.covariance(at(Parameter::k_bv), at(Parameter::k_h)));
}

TEST(TagRegression, KeepsThresholdsWithinTheirRange) {
  std::vector<TaggedFabric> fabrics = made_fabrics(100, 8, 0.1);
  for (TaggedFabric& tagged : fabrics) tagged.fabric.t_bu = std::min(1., tagged.tag.areal_density);
  Tag heavy = fabrics.front().tag;
  heavy.areal_density = 1e4;
  EXPECT_EQ(TagRegression(fabrics).predict({Parameter::t_bu}, heavy).mean[0], 1);
}

TEST(TagRegression, OrderChangesTheFoldsAlone) {
  std::vector<TaggedFabric> fabrics = model_fabrics(300, 9);
  const Tag tag = fabrics[5].tag;
  const Prior first = TagRegression(fabrics).predict(kAll, tag),
              again = TagRegression(fabrics).predict(kAll, tag);
  EXPECT_EQ(first.mean, again.mean);
  EXPECT_EQ(first.covariance, again.covariance);
  std::reverse(fabrics.begin(), fabrics.end());
  const Prior other = TagRegression(fabrics).predict(kAll, tag);
  for (int i = 0; i < kParameterCount; ++i) {
    // other folds may choose the neighbouring penalty
    const double sd = std::sqrt(first.covariance(i, i));
    EXPECT_NEAR(other.mean[i], first.mean[i], 0.15 * sd) << name(kAll[static_cast<size_t>(i)]);
    EXPECT_NEAR(std::sqrt(other.covariance(i, i)), sd, 0.05 * sd);
  }
}

TEST(TagRegression, IsNearlyAsGoodAsTheModelItLearnsFrom) {
  const std::vector<Parameter> learned{Parameter::k_u,  Parameter::k_v,  Parameter::k_h,
                                       Parameter::k_bu, Parameter::k_bv, Parameter::k_bh};
  const TagRegression regression(model_fabrics(1000, 1));
  VecX of_regression = VecX::Zero(6), of_model = VecX::Zero(6);
  for (const TaggedFabric& other : model_fabrics(12, 2)) {
    const VecX truth = ParameterSpace{learned, {}}.encode(other.fabric);
    of_regression += (regression.predict(learned, other.tag).mean - truth).cwiseAbs2();
    of_model +=
        (prior_from_tag(learned, other.tag, BendingThreshold::printed).mean - truth).cwiseAbs2();
  }
  for (int i = 0; i < 6; ++i)
    EXPECT_LT(std::sqrt(of_regression[i] / of_model[i]), 1.2)
        << name(learned[static_cast<size_t>(i)]);
}

TEST(TagRegression, RefusesWhatItCannotLearnFrom) {
  const std::vector<TaggedFabric> good = made_fabrics(TagRegression::kFewest, 10, 0.5);
  const auto with = [&](const std::function<void(TaggedFabric&)>& change) {
    std::vector<TaggedFabric> fabrics = good;
    fabrics[3].tag = tag_of_type("Twill");
    fabrics[3].tag.composition = {{"Cotton", 100}};
    change(fabrics[3]);
    return error_of([&] { TagRegression{fabrics}; });
  };
  EXPECT_EQ(with([](TaggedFabric&) {}), "no error");
  EXPECT_EQ(with([](TaggedFabric& f) { f.tag.type = f.tag.subcategory = ""; }), "no error");
  EXPECT_EQ(with([](TaggedFabric& f) { f.tag.composition.clear(); }), "no error");
  EXPECT_EQ(with([](TaggedFabric& f) { f.tag.type = "Twil"; }), "fabric 'x': unknown type 'Twil'");
  EXPECT_EQ(with([](TaggedFabric& f) { f.tag.composition[0].name = "Gold"; }),
            "fabric 'x': unknown fibre 'Gold'");
  const auto says = [&](const char* text, const std::function<void(TaggedFabric&)>& change) {
    const std::string error = with(change);
    EXPECT_NE(error.find(text), std::string::npos) << error;
  };
  says("category 'Felt'; expected", [](TaggedFabric& f) { f.tag.category = "Felt"; });
  says("is of 'Woven', 'Twill', not of 'Cut & Sew knit', 'Twill'",
       [](TaggedFabric& f) { f.tag.category = "Cut & Sew knit"; });
  says("not of 'Woven', 'Satin'", [](TaggedFabric& f) { f.tag.subcategory = "Satin"; });
  says("unknown subcategory 'Weird' of 'Woven'", [](TaggedFabric& f) {
    f.tag.type = "";
    f.tag.subcategory = "Weird";
  });
  says("areal density 0 kg/m^2", [](TaggedFabric& f) { f.tag.areal_density = 0; });
  says("k_u = nan; must be finite and > 0",
       [](TaggedFabric& f) { f.fabric.k_u = std::numeric_limits<double>::quiet_NaN(); });
  says("s_bh = 0; must be finite and > 0", [](TaggedFabric& f) { f.fabric.s_bh = 0; });
  says("t_bv = inf; must be finite",
       [](TaggedFabric& f) { f.fabric.t_bv = std::numeric_limits<double>::infinity(); });

  const std::vector<TaggedFabric> few(good.begin() + 1, good.end());
  EXPECT_EQ(
      error_of([&] { TagRegression{few}; }),
      "what a tag tells cannot be learned from 19 fabrics with a tag; at least 20 are needed");
  Tag unknown = good.front().tag;
  unknown.type = "Twil";
  EXPECT_EQ(error_of([&] { TagRegression(good).predict(kAll, unknown); }), "unknown type 'Twil'");
}

}  // namespace
}  // namespace drape::test
