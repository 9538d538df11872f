// A camera above the instrument that looks straight down: where it sees the points of a state.
//
// A pinhole at height H over the middle of the support sees (x, y, z) at H / (H - z) (x, y) in the
// plane of the support, z = 0; H infinite is the orthographic view. Straight lines stay straight:
// the outline of what is seen is that of the points as seen (outline.h).
#pragma once

#include <limits>

#include "core/types.h"

namespace drape {

struct Camera {
  double height = std::numeric_limits<double>::infinity();  ///< H [m]

  bool orthographic() const { return height == std::numeric_limits<double>::infinity(); }
  /// The state (3n) with its x and y as seen. Throws std::runtime_error if a point is as high as
  /// the camera.
  VecX seen(const VecX& x) const;
  /// dL/dx (3n) from dL/dseen (3n).
  VecX pull_back(const VecX& x, const VecX& dL_dseen) const;
  /// Velocity as seen when the state moves with velocity dx (3n).
  VecX push_forward(const VecX& x, const VecX& dx) const;
};

}  // namespace drape
