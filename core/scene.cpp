#include "core/scene.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace drape {

double column_radius(const Scene& scene) {
  return scene.column_radius > 0 ? scene.column_radius : scene.support_radius;
}

void validate(const Scene& scene) {
  std::ostringstream message;
  if (!std::isfinite(scene.specimen_radius) || !(scene.support_radius > 0) ||
      !(scene.specimen_radius > scene.support_radius))
    message << "scene radii: support " << scene.support_radius << " m, specimen "
            << scene.specimen_radius << " m: must be 0 < support < specimen";
  else if (!std::isfinite(scene.gravity) || !(scene.gravity > 0))
    message << "scene gravity = " << scene.gravity << ": must be a finite number > 0 m/s^2";
  else if (!(scene.column_radius >= 0 && scene.column_radius <= scene.support_radius))
    message << "scene column_radius = " << scene.column_radius
            << " m: must be within 0 and the support_radius, " << scene.support_radius << " m";
  else
    return;
  throw std::invalid_argument(message.str());
}

}  // namespace drape
