#include "adjoint/loss.h"

#include <stdexcept>
#include <string>

namespace drape {

Loss profile_loss(const Outline& outline, const VecX& observed, const Vec2& centre) {
  if (observed.size() != kProfileSize)
    throw std::invalid_argument("profile loss: " + std::to_string(observed.size()) +
                                " observed radii; there must be " + std::to_string(kProfileSize));
  const Profile profile = radial_profile(outline.points, centre);
  const VecX miss = profile.radius - observed;
  return {0.5 * miss.squaredNorm() / kProfileSize,
          pull_back(profile, outline.points, centre, miss / kProfileSize)};
}

Loss coverage_loss(const Outline& outline, const PixelGrid& grid, const CoverageImage& observed) {
  if (observed.rows() != grid.rows || observed.cols() != grid.columns)
    throw std::invalid_argument("coverage loss: the observed image is " +
                                std::to_string(observed.rows()) + " x " +
                                std::to_string(observed.cols()) + " pixels, the grid " +
                                std::to_string(grid.rows) + " x " + std::to_string(grid.columns));
  const double pixel_area = grid.pixel_size * grid.pixel_size;
  const CoverageImage miss = coverage(outline.points, grid) - observed;
  return {0.5 * pixel_area * miss.squaredNorm(),
          pull_back(outline.points, grid, pixel_area * miss)};
}

Loss drape_coefficient_loss(const Outline& outline, const Scene& scene) {
  // DC is affine in the area, so its slope is the difference over one unit of area
  const double slope = drape_coefficient(scene, 1) - drape_coefficient(scene, 0);
  return {drape_coefficient(scene, area(outline.points)), slope * area_gradient(outline.points)};
}

}  // namespace drape
