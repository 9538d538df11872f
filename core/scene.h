// Cusick's drape test: a circular specimen hangs over a circular support.
#pragma once

namespace drape {

struct Scene {
  double specimen_radius = 0.15;  ///< [m]
  double support_radius = 0.09;   ///< radius of the clamping disc [m]
  double gravity = 9.80665;       ///< [m/s^2]
  double column_radius = 0;       ///< of what stands below the disc [m]; 0: as wide as the disc
};

/// The radius of the column below the disc, never 0 [m].
double column_radius(const Scene& scene);

/// Throws std::invalid_argument unless 0 < support_radius < specimen_radius, gravity > 0 and
/// 0 <= column_radius <= support_radius.
void validate(const Scene& scene);

}  // namespace drape
