// Cusick's drape test: a circular specimen hangs over a circular support.
#pragma once

namespace drape {

struct Scene {
  double specimen_radius = 0.15;  ///< [m]
  double support_radius = 0.09;   ///< radius of the clamping disc [m]
  double gravity = 9.80665;       ///< [m/s^2]
};

/// Throws std::invalid_argument unless 0 < support_radius < specimen_radius and gravity > 0.
void validate(const Scene& scene);

}  // namespace drape
