#include "estimation/picture_misfit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "adjoint/adjoint.h"
#include "core/coverage.h"
#include "core/profile.h"
#include "core/signed_distance.h"

namespace drape {
namespace {

constexpr size_t kKnownDrapes = 6;

/// psi with psi^2 = Huber's loss (e^2 up to the threshold, linear beyond) and its derivative.
struct RobustMiss {
  double value, derivative;
};

RobustMiss robust(double e, double threshold) {
  if (threshold == 0 || std::abs(e) <= threshold) return {e, 1};
  const double value = std::sqrt(threshold * (2 * std::abs(e) - threshold));
  return {std::copysign(value, e), threshold / value};
}

}  // namespace

/// The residuals of an outline as seen, and the maps of their derivatives.
struct PictureMisfit::Residuals {
  VecX r;
  std::function<VecX(const Points2& velocity)> push_forward;
  std::function<Points2(const VecX& dL_dr)> pull_back;
};

PictureMisfit::PictureMisfit(Picture picture, const MisfitOptions& options)
    : picture_(std::move(picture)),
      options_(options),
      nuisances_(picture_.seen.nuisances()),
      potential_(picture_.model) {
  const OutlineObservation& seen = picture_.seen;
  validate(seen);
  if (options.loss == OutlineLoss::coverage &&
      (seen.coverage.rows() != seen.grid.rows || seen.coverage.cols() != seen.grid.columns))
    throw std::invalid_argument("the coverage loss needs a coverage image of the size of its grid");
  if (options.loss == OutlineLoss::signed_distance) {
    if (seen.outline.rows() < 3)
      throw std::invalid_argument("the signed-distance loss needs an observed outline");
    observed_ = equally_spaced(seen.outline, kProfileSize);
  }
}

int PictureMisfit::residual_count() const {
  return options_.loss == OutlineLoss::coverage ? static_cast<int>(picture_.seen.coverage.size())
                                                : kProfileSize;
}

void PictureMisfit::start_from(const Potential& potential, BranchPoint point,
                               const ContinuationOptions& continuation) {
  potential_ = potential;
  continuation_ = continuation;
  known_.clear();
  known_.push_back(std::move(point));
}

double PictureMisfit::distance_from_known(const VecX& z) const {
  double least = std::numeric_limits<double>::infinity();
  for (const BranchPoint& known : known_)
    least = std::min(least, (known.z - z).cwiseAbs().maxCoeff());
  return least;
}

const BranchPoint* PictureMisfit::drape_at(const ParameterSpace& space, const VecX& z,
                                           bool may_solve) {
  const auto nearest =
      std::min_element(known_.begin(), known_.end(), [&](const auto& a, const auto& b) {
        return (a.z - z).squaredNorm() < (b.z - z).squaredNorm();
      });
  if (nearest->z == z) {
    std::rotate(nearest, nearest + 1, known_.end());
    return &known_.back();
  }
  std::optional<BranchPoint> reached;
  if (may_solve) reached = follow_branch(potential_, space, *nearest, z, continuation_, &work_);
  if (!reached) return nullptr;
  if (known_.size() >= kKnownDrapes) known_.erase(known_.begin());
  known_.push_back(*std::move(reached));
  return &known_.back();
}

PictureMisfit::Residuals PictureMisfit::residuals_of(const Points2& points) const {
  const OutlineObservation& seen = picture_.seen;
  if (options_.loss == OutlineLoss::coverage) {
    // a radial miss d all round costs 1/2 N (d / noise)^2 in the profile; in the image it covers
    // d 2 pi r
    const double scale =
        seen.grid.pixel_size * std::sqrt(seen.independent_values() /
                                         (seen.noise * 2 * std::numbers::pi * seen.profile.mean()));
    const CoverageImage miss = scale * (coverage(points, seen.grid) - seen.coverage);
    return {miss.reshaped<Eigen::RowMajor>(),
            [&seen, points, scale](const Points2& velocity) -> VecX {
              return scale * push_forward(points, seen.grid, velocity).reshaped<Eigen::RowMajor>();
            },
            [&seen, points, scale](const VecX& dL_dr) -> Points2 {
              return pull_back(
                  points, seen.grid,
                  scale * dL_dr.reshaped<Eigen::RowMajor>(seen.grid.rows, seen.grid.columns));
            }};
  }
  const auto scaled = [&](const VecX& misses) {
    const double scale = std::sqrt(1.0 * seen.independent_values() / kProfileSize);
    std::pair<VecX, VecX> result{VecX(kProfileSize), VecX(kProfileSize)};  // r and dr/dmiss
    for (int i = 0; i < kProfileSize; ++i) {
      const RobustMiss miss = robust(misses[i] / seen.noise, options_.huber);
      result.first[i] = scale * miss.value;
      result.second[i] = scale * miss.derivative / seen.noise;
    }
    return result;
  };
  if (options_.loss == OutlineLoss::signed_distance) {
    const SignedDistances distances = signed_distances(points, observed_);
    const auto [r, slope] = scaled(distances.distance);
    return {r,
            [distances, slope = slope](const Points2& velocity) -> VecX {
              return slope.cwiseProduct(push_forward(distances, velocity));
            },
            [distances, points, slope = slope](const VecX& dL_dr) -> Points2 {
              return pull_back(distances, points, slope.cwiseProduct(dL_dr));
            }};
  }
  const Profile profile = radial_profile(points);
  const auto [r, slope] = scaled(profile.radius - seen.profile);
  return {r,
          [profile, points, slope = slope](const Points2& velocity) -> VecX {
            return slope.cwiseProduct(push_forward(profile, points, Vec2::Zero(), velocity));
          },
          [profile, points, slope = slope](const VecX& dL_dr) -> Points2 {
            return pull_back(profile, points, Vec2::Zero(), slope.cwiseProduct(dL_dr));
          }};
}

void PictureMisfit::residuals(const BranchPoint& drape, const VecX& v, VecX& r,
                              MatX* jacobian) const {
  const Camera& camera = picture_.seen.camera;
  const VecX x = camera.seen(drape.equilibrium.x);
  const Placement place = placement(picture_.seen, v);
  const Outline outline = trace_outline(potential_.mesh(), picture_.scene, x);
  const Points2 points = place.seen(outline.points);
  const Residuals seen = residuals_of(points);
  r = seen.r;
  if (jacobian == nullptr) return;

  const Eigen::Index p = drape.dx_dz.cols();
  jacobian->resize(r.size(), p + nuisances_);
  for (Eigen::Index i = 0; i < p; ++i) {
    const VecX dx = camera.push_forward(drape.equilibrium.x, drape.dx_dz.col(i));
    jacobian->col(i) = seen.push_forward(place.push_forward(push_forward(outline, x, dx)));
  }
  for (int k = 0; k < nuisances_; ++k)
    jacobian->col(p + k) = seen.push_forward(nuisance_velocity(picture_.seen, place, points, k));
}

double PictureMisfit::cost(const ParameterSpace& space, const BranchPoint& drape, const VecX& v,
                           VecX* gradient) {
  const Camera& camera = picture_.seen.camera;
  const VecX x = camera.seen(drape.equilibrium.x);
  const Placement place = placement(picture_.seen, v);
  const Outline outline = trace_outline(potential_.mesh(), picture_.scene, x);
  const Points2 points = place.seen(outline.points);
  const Residuals seen = residuals_of(points);
  const double value = 0.5 * seen.r.squaredNorm();
  if (gradient == nullptr) return value;

  const Points2 dJ_dpoints = seen.pull_back(seen.r);
  const VecX dJ_dseen = pull_back(outline, x, place.pull_back(dJ_dpoints));
  potential_.set_fabric(space.decode(drape.z));
  const ParameterVector dJ_dp = adjoint_gradient(potential_, drape.equilibrium,
                                                 camera.pull_back(drape.equilibrium.x, dJ_dseen));
  const VecX dp_dz = space.derivative(drape.z);
  gradient->resize(space.size() + nuisances_);
  for (int i = 0; i < space.size(); ++i)
    (*gradient)[i] = dJ_dp[static_cast<int>(space.parameters[static_cast<size_t>(i)])] * dp_dz[i];
  for (int k = 0; k < nuisances_; ++k)
    (*gradient)[space.size() + k] =
        dJ_dpoints.cwiseProduct(nuisance_velocity(picture_.seen, place, points, k)).sum();
  return value;
}

}  // namespace drape
