// The plate that carries a specimen before a drape test: a smooth one-sided support under it.
//
//   E_plate = sum over free vertices of w_i delta/3 max(0, (height - z_i) / delta)^3
//
// with w_i the weight of vertex i and delta the give of the plate: a vertex that lies there alone
// sinks in by delta. C2 and without friction. It stands for the annular plate around the support;
// a state that touches it is no drape, only a means to reach one (lowering.h).
#pragma once

namespace drape {

struct Plate {
  double height = 0;   ///< [m], the top of the support at 0
  double give = 1e-4;  ///< delta [m]
};

/// Energy over the vertex' weight [m] of a vertex at height z, and its derivatives in z [1, 1/m].
struct PlatePush {
  double energy, slope, curvature;
};
inline PlatePush plate_push(const Plate& plate, double z) {
  const double depth = (plate.height - z) / plate.give;
  if (depth <= 0) return {0, 0, 0};
  return {plate.give / 3 * depth * depth * depth, -depth * depth, 2 * depth / plate.give};
}

}  // namespace drape
