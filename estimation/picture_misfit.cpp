#include "estimation/picture_misfit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "adjoint/adjoint.h"
#include "adjoint/loss.h"

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

/// The residuals of a profile and their slopes dr/drho.
struct ProfileResiduals {
  VecX r, slope;
};

ProfileResiduals profile_residuals(const Profile& profile, const OutlineObservation& seen,
                                   double huber) {
  const double scale = std::sqrt(1.0 * seen.independent_values() / kProfileSize);
  ProfileResiduals result{VecX(kProfileSize), VecX(kProfileSize)};
  for (int i = 0; i < kProfileSize; ++i) {
    const RobustMiss miss = robust((profile.radius[i] - seen.profile[i]) / seen.noise, huber);
    result.r[i] = scale * miss.value;
    result.slope[i] = scale * miss.derivative / seen.noise;
  }
  return result;
}

/// The outline as its picture shows it; its corners are those of the drape's.
Outline placed(const Outline& outline, const Placement& placement) {
  Outline seen = outline;
  seen.points = placement.seen(outline.points);
  return seen;
}

}  // namespace

struct PictureMisfit::OutlineCost {
  double value;
  Points2 dJ_dpoints;
};

PictureMisfit::PictureMisfit(Picture picture, const MisfitOptions& options)
    : picture_(std::move(picture)),
      options_(options),
      nuisances_(picture_.seen.nuisances()),
      potential_(picture_.model) {
  validate(picture_.seen);
}

void PictureMisfit::start_from(const Potential& potential, BranchPoint point,
                               const ContinuationOptions& continuation) {
  potential_ = potential;
  continuation_ = continuation;
  known_.clear();
  known_.push_back(std::move(point));
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

void PictureMisfit::residuals(const BranchPoint& drape, const VecX& v, VecX& r,
                              MatX* jacobian) const {
  const VecX& x = drape.equilibrium.x;
  const Placement place = placement(picture_.seen, v);
  const Outline outline = trace_outline(potential_.mesh(), picture_.scene, x);
  const Points2 points = place.seen(outline.points);
  const Profile profile = radial_profile(points);
  ProfileResiduals residuals = profile_residuals(profile, picture_.seen, options_.huber);
  r = std::move(residuals.r);
  if (jacobian == nullptr) return;

  const Eigen::Index p = drape.dx_dz.cols();
  jacobian->resize(kProfileSize, p + nuisances_);
  const auto rate = [&](const Points2& velocity) -> VecX {
    return residuals.slope.cwiseProduct(push_forward(profile, points, Vec2::Zero(), velocity));
  };
  for (Eigen::Index i = 0; i < p; ++i)
    jacobian->col(i) = rate(place.push_forward(push_forward(outline, x, drape.dx_dz.col(i))));
  for (int k = 0; k < nuisances_; ++k)
    jacobian->col(p + k) = rate(nuisance_velocity(picture_.seen, place, points, k));
}

PictureMisfit::OutlineCost PictureMisfit::outline_cost(const Outline& seen) const {
  const OutlineObservation& observed = picture_.seen;
  if (options_.loss == OutlineLoss::profile) {
    const Profile profile = radial_profile(seen.points);
    const auto [r, slope] = profile_residuals(profile, observed, options_.huber);
    return {0.5 * r.squaredNorm(),
            pull_back(profile, seen.points, Vec2::Zero(), r.cwiseProduct(slope))};
  }
  // a radial miss d all round costs 1/2 N (d / noise)^2 in the profile; in the image it covers
  // d 2 pi r
  const double scale = observed.independent_values() /
                       (observed.noise * 2 * std::numbers::pi * observed.profile.mean());
  const Loss loss = coverage_loss(seen, observed.grid, observed.coverage);
  return {scale * loss.value, scale * loss.dL_dpoints};
}

double PictureMisfit::cost(const ParameterSpace& space, const BranchPoint& drape, const VecX& v,
                           VecX* gradient) {
  const VecX& x = drape.equilibrium.x;
  const Placement place = placement(picture_.seen, v);
  const Outline outline = trace_outline(potential_.mesh(), picture_.scene, x);
  const Outline seen = placed(outline, place);
  const OutlineCost cost = outline_cost(seen);
  if (gradient == nullptr) return cost.value;

  potential_.set_fabric(space.decode(drape.z));
  const ParameterVector dJ_dp = adjoint_gradient(
      potential_, drape.equilibrium, pull_back(outline, x, place.pull_back(cost.dJ_dpoints)));
  const VecX dp_dz = space.derivative(drape.z);
  gradient->resize(space.size() + nuisances_);
  for (int i = 0; i < space.size(); ++i)
    (*gradient)[i] = dJ_dp[static_cast<int>(space.parameters[static_cast<size_t>(i)])] * dp_dz[i];
  for (int k = 0; k < nuisances_; ++k)
    (*gradient)[space.size() + k] =
        cost.dJ_dpoints.cwiseProduct(nuisance_velocity(picture_.seen, place, seen.points, k)).sum();
  return cost.value;
}

}  // namespace drape
