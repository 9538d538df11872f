#include "estimation/picture.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace drape {
namespace {

constexpr double kCentreUnit = 1e-3;    // [m]
constexpr double kCentreSd = 5;         // [mm]
constexpr double kLargestCentre = 10;   // [mm]
constexpr double kLargestTurn = 0.785;  // [rad]; beyond, another start is nearer
constexpr int kDepthIterations = 20;    // each gains a factor of depth over height

enum class Nuisance { centre_x, centre_y, weft_angle, log_scale };

std::vector<Nuisance> nuisances_of(const OutlineObservation& seen) {
  std::vector<Nuisance> list;
  if (!seen.centre_known) list = {Nuisance::centre_x, Nuisance::centre_y};
  if (seen.weft_angle_sd > 0) list.push_back(Nuisance::weft_angle);
  if (seen.scale_log_sd > 0) list.push_back(Nuisance::log_scale);
  return list;
}

/// One value a nuisance.
template <typename Value>
VecX values_of(const OutlineObservation& seen, const Value& value) {
  const std::vector<Nuisance> list = nuisances_of(seen);
  VecX values(static_cast<Eigen::Index>(list.size()));
  for (size_t k = 0; k < list.size(); ++k) values[static_cast<Eigen::Index>(k)] = value(list[k]);
  return values;
}

/// exp(-s) R(phi), acting on columns.
Eigen::Matrix2d seen_from_drape(const Placement& placement) {
  return std::exp(-placement.log_scale) *
         Eigen::Rotation2Dd(placement.weft_angle).toRotationMatrix();
}

/// The profile that an orthographic view would show where the rim hangs from the support along
/// straight generators.
VecX orthographic_profile(const OutlineObservation& seen, const Scene& scene) {
  if (seen.camera.orthographic()) return seen.profile;
  const double overhang = scene.specimen_radius - scene.support_radius;
  VecX profile = seen.profile;
  for (double& radius : profile) {
    const double apparent = radius;
    for (int i = 0; i < kDepthIterations; ++i) {
      const double reach = std::clamp(radius - scene.support_radius, 0.0, overhang);
      const double depth = std::sqrt(overhang * overhang - reach * reach);
      radius = std::min(apparent * (1 + depth / seen.camera.height), scene.specimen_radius);
    }
  }
  return profile;
}

}  // namespace

int OutlineObservation::nuisances() const { return static_cast<int>(nuisances_of(*this).size()); }

void validate(const OutlineObservation& seen) {
  std::ostringstream wrong;
  if (seen.profile.size() != kProfileSize || !seen.profile.allFinite())
    wrong << "the observed profile must hold " << kProfileSize << " finite radii";
  else if (!(seen.noise > 0))
    wrong << "the noise of an observed profile is " << seen.noise << " m; must be > 0";
  else if (seen.noise_harmonics < 0 || 2 * seen.noise_harmonics >= kProfileSize)
    wrong << "the noise of an observed profile fills " << seen.noise_harmonics
          << " harmonics; must be at least 0 and less than " << kProfileSize / 2;
  else if (!(seen.weft_angle_sd >= 0) || !(seen.scale_log_sd >= 0))
    wrong << "the standard deviations of weft angle and scale are " << seen.weft_angle_sd << " and "
          << seen.scale_log_sd << "; must be >= 0";
  else if (!(seen.camera.height > 0))
    wrong << "the camera is " << seen.camera.height << " m above the support; must be > 0";
  if (!wrong.str().empty()) throw std::invalid_argument(wrong.str());
}

Points2 Placement::seen(const Points2& drape) const {
  return push_forward(drape.rowwise() - centre.transpose());
}

Points2 Placement::unseen(const Points2& picture) const {
  Points2 drape = picture * seen_from_drape(*this).inverse().transpose();
  drape.rowwise() += centre.transpose();
  return drape;
}

Points2 Placement::pull_back(const Points2& dL_dseen) const {
  return dL_dseen * seen_from_drape(*this);
}

Points2 Placement::push_forward(const Points2& velocity) const {
  return velocity * seen_from_drape(*this).transpose();
}

Placement placement(const OutlineObservation& seen, const VecX& nuisances) {
  Placement result;
  result.weft_angle = seen.weft_angle;
  Eigen::Index k = 0;
  for (const Nuisance nuisance : nuisances_of(seen)) {
    const double v = nuisances[k++];
    switch (nuisance) {
      case Nuisance::centre_x:
        result.centre.x() = kCentreUnit * v;
        break;
      case Nuisance::centre_y:
        result.centre.y() = kCentreUnit * v;
        break;
      case Nuisance::weft_angle:
        result.weft_angle += v;
        break;
      case Nuisance::log_scale:
        result.log_scale = v;
        break;
    }
  }
  return result;
}

VecX nuisance_sd(const OutlineObservation& seen) {
  return values_of(seen, [&](Nuisance nuisance) {
    return nuisance == Nuisance::weft_angle  ? seen.weft_angle_sd
           : nuisance == Nuisance::log_scale ? seen.scale_log_sd
                                             : kCentreSd;
  });
}

VecX nuisance_bounds(const OutlineObservation& seen) {
  return values_of(seen, [&](Nuisance nuisance) {
    return nuisance == Nuisance::weft_angle  ? kLargestTurn
           : nuisance == Nuisance::log_scale ? 4 * seen.scale_log_sd
                                             : kLargestCentre;
  });
}

Points2 nuisance_velocity(const OutlineObservation& seen, const Placement& placement,
                          const Points2& points, int k) {
  Points2 velocity(points.rows(), 2);
  switch (nuisances_of(seen)[static_cast<size_t>(k)]) {
    case Nuisance::centre_x:
      velocity.rowwise() = -kCentreUnit * seen_from_drape(placement).col(0).transpose();
      break;
    case Nuisance::centre_y:
      velocity.rowwise() = -kCentreUnit * seen_from_drape(placement).col(1).transpose();
      break;
    case Nuisance::weft_angle:
      velocity << -points.col(1), points.col(0);
      break;
    case Nuisance::log_scale:
      velocity = -points;
      break;
  }
  return velocity;
}

Guide guide_towards(const OutlineObservation& seen, const Scene& scene, const Placement& placement,
                    int harmonic_count, double kappa) {
  // r(alpha) in the drape's axes is exp(s) r_seen(alpha + phi)
  Harmonics radius = harmonics(orthographic_profile(seen, scene), harmonic_count);
  for (Eigen::Index k = 0; k < radius.a.size(); ++k) {
    const Vec2 turned = std::exp(placement.log_scale) *
                        (Eigen::Rotation2Dd(-static_cast<double>(k) * placement.weft_angle) *
                         Vec2(radius.a[k], radius.b[k]));
    radius.a[k] = turned.x();
    radius.b[k] = turned.y();
  }
  return {radius, placement.centre, kappa};
}

}  // namespace drape
