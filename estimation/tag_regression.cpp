#include "estimation/tag_regression.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/random.h"
#include "estimation/csv_table.h"
#include "estimation/tag_features.h"

namespace drape {
namespace {

constexpr int kFolds = 10;
constexpr std::uint64_t kShuffleSeed = 1;
constexpr double kInterval90 = 1.645;  // standard deviations of a normal
/// Standard deviations of z below it are rounding.
constexpr double kConstant = 1e-9;
/// C of a structure is that of its own fabrics and of this many that scatter as all do.
constexpr double kPooledFabrics = 30;

const std::vector<Parameter>& all() {
  static const std::vector<Parameter> list(all_parameters().begin(), all_parameters().end());
  return list;
}

/// 1e-3 to 1e6, two a decade.
const std::vector<double>& penalty_grid() {
  static const std::vector<double> grid = [] {
    std::vector<double> values;
    for (int i = -6; i <= 12; ++i) values.push_back(std::pow(10, 0.5 * i));
    return values;
  }();
  return grid;
}

/// A fabric a row.
MatX features_of(const std::vector<TaggedFabric>& fabrics) {
  if (fabrics.size() < static_cast<size_t>(TagRegression::kFewest))
    throw std::invalid_argument("what a tag tells cannot be learned from " +
                                std::to_string(fabrics.size()) + " fabrics with a tag; at least " +
                                std::to_string(TagRegression::kFewest) + " are needed");
  MatX rows;
  for (size_t i = 0; i < fabrics.size(); ++i) try {
      const VecX x = tag_features(fabrics[i].tag);
      if (i == 0) rows.resize(static_cast<Eigen::Index>(fabrics.size()), x.size());
      rows.row(static_cast<Eigen::Index>(i)) = x;
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("fabric " + in_quotes(fabrics[i].tag.id) + ": " + error.what());
    }
  return rows;
}

MatX z_of(const std::vector<TaggedFabric>& fabrics) {
  MatX rows(static_cast<Eigen::Index>(fabrics.size()), kParameterCount);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const TaggedFabric& fabric = fabrics[static_cast<size_t>(i)];
    rows.row(i) = ParameterSpace{all(), fabric.fabric}.encode(fabric.fabric);
    for (const Parameter p : all())
      if (!std::isfinite(rows(i, static_cast<int>(p))))
        throw std::invalid_argument("fabric " + in_quotes(fabric.tag.id) + ": " +
                                    std::string(name(p)) + " = " + shown(fabric.fabric[p]) +
                                    "; must be finite" + (is_logarithmic(p) ? " and > 0" : ""));
  }
  return rows;
}

/// The places of a list of fabrics by fold.
std::vector<std::vector<Eigen::Index>> folds(Eigen::Index count) {
  std::vector<Eigen::Index> places(static_cast<size_t>(count));
  std::iota(places.begin(), places.end(), 0);
  Random random(kShuffleSeed);
  for (size_t i = places.size() - 1; i > 0; --i)  // Fisher and Yates
    std::swap(places[i], places[static_cast<size_t>(random.uniform() * double(i + 1))]);
  std::vector<std::vector<Eigen::Index>> by_fold(kFolds);
  for (size_t i = 0; i < places.size(); ++i) by_fold[i % kFolds].push_back(places[i]);
  return by_fold;
}

/// Each fold's fabrics, and the regression on those of the others.
struct Fold {
  std::vector<Eigen::Index> held_out;
  RidgeRegression ridge;
};

std::vector<Fold> fit_folds(const MatX& x, const MatX& z) {
  std::vector<Fold> fitted;
  const auto by_fold = folds(x.rows());
  for (const auto& held_out : by_fold) {
    std::vector<Eigen::Index> others;
    for (const auto& fold : by_fold)
      if (&fold != &held_out) others.insert(others.end(), fold.begin(), fold.end());
    fitted.push_back({held_out, {x(others, Eigen::all), z(others, Eigen::all)}});
  }
  return fitted;
}

/// Of each parameter the one with the least squared errors.
VecX best_penalties(const MatX& x, const MatX& z, const std::vector<Fold>& fitted) {
  VecX best(z.cols()), least = VecX::Constant(z.cols(), std::numeric_limits<double>::infinity());
  for (const double penalty : penalty_grid()) {
    const VecX penalties = VecX::Constant(z.cols(), penalty);
    VecX squares = VecX::Zero(z.cols());
    for (const Fold& fold : fitted)
      for (const Eigen::Index i : fold.held_out)
        squares += (z.row(i).transpose() - fold.ridge.mean(x.row(i), penalties)).cwiseAbs2();
    for (Eigen::Index j = 0; j < z.cols(); ++j)
      if (squares[j] < least[j]) {
        least[j] = squares[j];
        best[j] = penalty;
      }
  }
  return best;
}

}  // namespace

TagRegression::TagRegression(const std::vector<TaggedFabric>& fabrics)
    : TagRegression(features_of(fabrics), z_of(fabrics), fabrics) {}

TagRegression::TagRegression(const MatX& x, const MatX& z, const std::vector<TaggedFabric>& fabrics)
    : count_(static_cast<int>(x.rows())), ridge_(x, z) {
  const std::vector<Fold> fitted = fit_folds(x, z);
  penalties_ = best_penalties(x, z, fitted);
  MatX errors(z.rows(), z.cols()), factors = errors;
  for (const Fold& fold : fitted)
    for (const Eigen::Index i : fold.held_out) {
      errors.row(i) = z.row(i) - fold.ridge.mean(x.row(i), penalties_).transpose();
      factors.row(i) = fold.ridge.error_factors(x.row(i), penalties_);
    }

  const MatX standard = errors.cwiseQuotient(factors);
  const auto index = [&](Eigen::Index i) {
    return static_cast<size_t>(
        structure_from_category(fabrics[static_cast<size_t>(i)].tag.category));
  };
  const MatX pooled = standard.transpose().lazyProduct(standard) / double(count_);
  std::array<double, 3> weight;
  weight.fill(kPooledFabrics);
  scatter_.fill(kPooledFabrics * pooled);
  for (Eigen::Index i = 0; i < z.rows(); ++i) {
    scatter_[index(i)] += standard.row(i).transpose() * standard.row(i);
    ++weight[index(i)];
  }
  for (size_t s = 0; s < scatter_.size(); ++s) scatter_[s] /= weight[s];

  for (int j = 0; j < kParameterCount; ++j) {
    const double squares = (z.col(j).array() - z.col(j).mean()).square().sum();
    if (!(squares > kConstant * kConstant * count_)) continue;
    int inside = 0;
    for (Eigen::Index i = 0; i < z.rows(); ++i)
      inside += std::abs(standard(i, j)) <= kInterval90 * std::sqrt(scatter_[index(i)](j, j));
    validation_[static_cast<size_t>(j)] = {true, 1 - errors.col(j).squaredNorm() / squares,
                                           std::sqrt(errors.col(j).squaredNorm() / count_),
                                           inside / double(count_)};
  }
}

Prior TagRegression::predict(const std::vector<Parameter>& parameters, const Tag& tag) const {
  const VecX x = tag_features(tag);
  const Structure structure = structure_from_category(tag.category);
  const VecX mean = ridge_.mean(x, penalties_);
  const VecX factors = ridge_.error_factors(x, penalties_);
  const MatX& C = scatter_[static_cast<size_t>(structure)];
  Prior prior = prior_from_weight(parameters, structure, tag.areal_density);
  const auto known = [&](Parameter p) {
    return p != Parameter::areal_density && validation(p).varies;
  };
  for (Eigen::Index a = 0; a < prior.mean.size(); ++a) {
    const Parameter p = parameters[static_cast<size_t>(a)];
    const int i = static_cast<int>(p);
    if (p != Parameter::areal_density) prior.mean[a] = mean[i];
    if (!is_logarithmic(p))
      prior.mean[a] = std::clamp(prior.mean[a], info(p).minimum, info(p).maximum);
    for (Eigen::Index b = 0; b < a; ++b) {
      const Parameter q = parameters[static_cast<size_t>(b)];
      const int j = static_cast<int>(q);
      const double both = known(p) && known(q) ? C(i, j) * factors[i] * factors[j] : 0;
      prior.covariance(a, b) = prior.covariance(b, a) = both;
    }
    if (known(p))
      prior.covariance(a, a) = C(i, i) * factors[i] * factors[i] + kWeighingSd * kWeighingSd;
  }
  return prior;
}

double TagRegression::coverage() const {
  double sum = 0;
  int varying = 0;
  for (const Parameter p : all()) {
    if (p == Parameter::areal_density || !validation(p).varies) continue;
    sum += validation(p).coverage;
    ++varying;
  }
  return varying > 0 ? sum / varying : std::nan("");
}

}  // namespace drape
