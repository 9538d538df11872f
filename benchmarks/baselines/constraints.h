// The potential as the methods of local steps see it: a sum over many small terms.
//
//   membrane: 1/2 k A (|w| - 1)^2 with w = sum_i c_i x_i, four directions a triangle (membrane.h)
//   bending:  U(delta), one wing each (bending.h)
//   weight:   linear
#pragma once

#include <array>
#include <vector>

#include "core/potential.h"

namespace drape::baselines {

/// One direction of one triangle: the stretch |w| is to be 1.
struct Direction {
  std::array<int, 3> vertices;
  Vec3 c;            ///< [1/m], sum 0
  double stiffness;  ///< k A [J]

  Vec3 stretched(const VecX& x) const {  // positions cancel before they are scaled
    const Vec3 origin = position(x, vertices[0]);
    return c[1] * (position(x, vertices[1]) - origin) + c[2] * (position(x, vertices[2]) - origin);
  }
};

struct BentWing {
  std::array<int, 4> vertices;
  WingLaw law;

  Corners4<double> corners(const VecX& x) const;
};

/// dE/d(delta) and d2E/d(delta)2 of a wing, tangent law or secant law off its jump.
struct Bending {
  double moment, tangent;
};
Bending bending(const WingLaw& law, double delta);

struct Constraints {
  std::vector<Direction> directions;
  std::vector<BentWing> wings;
  VecX weight;  ///< gradient of the weight's potential (3n) [N]
};

/// Throws std::invalid_argument for a potential with a guide, a plate or contact.
Constraints constraints_of(const Potential& potential);

}  // namespace drape::baselines
