// A guide pulls the rim of a drape towards an observed radial profile.
//
//   E = 1/2 kappa k_0 sum_i w_i (r_i - r_obs(alpha_i))^2
//
// over the free rim vertices, r and alpha their polar coordinates seen from above, w_i their share
// of the rim (sum 1). k_0 is such that at kappa = 1 a miss of 1 mm all round pulls with the weight
// of the free cloth. A guided state is a means to choose a branch; it is no drape until kappa = 0.
#pragma once

#include <vector>

#include "core/mesh.h"
#include "core/profile.h"

namespace drape {

struct Guide {
  Harmonics radius;            ///< r_obs(alpha) about `centre` [m]
  Vec2 centre = Vec2::Zero();  ///< of the observed outline, relative to the axis of the support [m]
  double kappa = 1;            ///< strength [1]; 0 switches the guide off
};

/// Rim vertices of a mesh and their shares w_i of the rim's rest length (sum 1).
struct Rim {
  std::vector<int> vertices;
  std::vector<double> share;
};
Rim rim_of(const Mesh& mesh);

/// Miss q = r - r_obs(alpha) of a rim vertex at p = (x, y) [m], with its derivatives.
struct GuideMiss {
  double value;
  Vec2 gradient;
  Eigen::Matrix2d hessian;
};
GuideMiss guide_miss(const Guide& guide, const Vec2& p);

}  // namespace drape
