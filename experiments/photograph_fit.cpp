#include "experiments/photograph_fit.h"

#include <numbers>

namespace drape {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRightAngle = 90;  // from weft to warp [deg]

}  // namespace

Picture picture_of(const Settings& settings, const Potential& model, const Photograph& photograph) {
  Picture picture{model, settings.scene, {}};
  picture.seen.profile = photograph.profile;
  picture.seen.noise = settings.photograph.outline_noise;
  picture.seen.noise_harmonics = settings.estimate.noise_harmonics;
  picture.seen.grid = photograph.grid;
  picture.seen.coverage = photograph.coverage;
  picture.seen.centre_known = false;
  picture.seen.weft_angle_sd = kDegree * settings.photograph.warp_angle_sd;
  picture.seen.scale_log_sd = settings.photograph.scale_log_sd;
  return picture;
}

WarpSearch fit_photographs(const Settings& settings, const Potential& model, const Fabric& first,
                           const std::vector<Photograph>& photographs,
                           const EstimateOptions& options) {
  std::vector<Picture> pictures;
  for (const Photograph& photograph : photographs)
    pictures.push_back(picture_of(settings, model, photograph));
  std::vector<double> weft_angles;
  for (const double angle : settings.photograph.warp_angles)
    weft_angles.push_back(kDegree * (angle - kRightAngle));
  return estimate_with_warp(std::move(pictures), weft_angles, first, options);
}

double warp_degrees(double weft_angle) { return weft_angle / kDegree + kRightAngle; }

}  // namespace drape
