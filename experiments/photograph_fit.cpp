#include "experiments/photograph_fit.h"

#include <numbers>

#include "experiments/tag_report.h"

namespace drape {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRightAngle = 90;  // from weft to warp [deg]

}  // namespace

Settings with_specimen(Settings settings, size_t file) {
  const std::vector<double>& radii = settings.photograph.specimen_radius_mm;
  if (!radii.empty()) settings.scene.specimen_radius = 1e-3 * radii[radii.size() == 1 ? 0 : file];
  return settings;
}

Settings with_photographs(Settings settings, const PhotographedFabric& fabric) {
  PhotographSettings& own = settings.photograph;
  own.files.clear();
  for (const std::filesystem::path& file : fabric.files)
    own.files.push_back(std::filesystem::absolute(file));
  own.mm_per_pixel = fabric.mm_per_pixel;
  own.areal_density = fabric.areal_density;
  own.specimen_radius_mm = fabric.specimen_radius_mm;
  if (fabric.warp_angle_deg) {
    own.warp_angles = {*fabric.warp_angle_deg};
    own.warp_angle_sd = 0;
  }
  own.type = fabric.type;
  own.composition = fabric.composition;
  if (fabric.has_tag()) own.prior = PriorKind::tag;
  settings.photograph_set = {};
  return settings;
}

std::optional<Tag> tag_of(const PhotographSettings& settings) {
  if (settings.type.empty()) return std::nullopt;
  return tag_from_words(settings.type, settings.composition, settings.areal_density);
}

Picture picture_of(const Settings& settings, const Potential& model, const Photograph& photograph) {
  Picture picture{model, settings.scene, {}};
  picture.seen.profile = photograph.profile;
  picture.seen.noise = settings.photograph.outline_noise;
  picture.seen.noise_harmonics = settings.estimate.noise_harmonics;
  picture.seen.grid = photograph.grid;
  picture.seen.coverage = photograph.coverage;
  picture.seen.outline = photograph.boundary;
  if (settings.photograph.camera_height_mm > 0)
    picture.seen.camera.height = 1e-3 * settings.photograph.camera_height_mm;
  picture.seen.centre_known = false;
  picture.seen.weft_angle_sd = kDegree * settings.photograph.warp_angle_sd;
  picture.seen.scale_log_sd = settings.photograph.scale_log_sd;
  return picture;
}

WarpSearch fit_pictures(const Settings& settings, std::vector<Picture> pictures,
                        const Fabric& first, const EstimateOptions& options) {
  std::vector<double> weft_angles;
  for (const double angle : settings.photograph.warp_angles)
    weft_angles.push_back(weft_angle(angle));
  return estimate_with_warp(std::move(pictures), weft_angles, first, options);
}

double warp_degrees(double weft_angle) { return weft_angle / kDegree + kRightAngle; }
double weft_angle(double warp_degrees) { return kDegree * (warp_degrees - kRightAngle); }

}  // namespace drape
