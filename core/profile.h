// Radial profile rho(alpha) of an outline and what is read off it: nodes and harmonics.
//
// rho(alpha) is the outermost distance from the centre to the outline in the direction alpha,
// alpha counted counter-clockwise from +x = weft.
#pragma once

#include <vector>

#include "core/types.h"

namespace drape {

/// Number of directions of a stored profile: whole degrees.
inline constexpr int kProfileSize = 360;

/// A profile and, for every direction, where the ray meets the outline: on the edge from corner
/// `edge[i]` to the next one, at the fraction `fraction[i]` of that edge.
struct Profile {
  VecX radius;                   ///< [m], kProfileSize values
  std::vector<int> edge;         ///< index of the corner at which the outermost edge starts
  std::vector<double> fraction;  ///< in [0, 1]
};

/// Profile of a counter-clockwise polygon about `centre` [m]. Throws std::invalid_argument if a ray
/// from the centre does not meet the polygon (the centre lies outside of it).
Profile radial_profile(const Points2& polygon, const Vec2& centre = Vec2::Zero());

/// dL/dpolygon (one row a corner) from dL/dradius (kProfileSize). The derivative with respect to
/// the centre is minus the sum of the rows.
Points2 pull_back(const Profile& profile, const Points2& polygon, const Vec2& centre,
                  const VecX& dL_dradius);

/// Rate of the radii when the corners move with velocity dpolygon (relative to the centre).
VecX push_forward(const Profile& profile, const Points2& polygon, const Vec2& centre,
                  const Points2& dpolygon);

/// Truncated Fourier series a_0 + sum_k a_k cos(k alpha) + b_k sin(k alpha) of uniformly sampled
/// values (sample i at alpha = 2 pi i / size).
struct Harmonics {
  VecX a, b;  ///< a: 0..K, b: 0..K with b[0] = 0
  double operator()(double alpha) const;
  double derivative(double alpha) const;         ///< d/dalpha
  double second_derivative(double alpha) const;  ///< d^2/dalpha^2
};
Harmonics harmonics(const VecX& samples, int count);

/// Nodes (folds): peaks of the 30-harmonic reconstruction with a prominence of at least 1.5 mm.
int node_count(const VecX& radius);

}  // namespace drape
