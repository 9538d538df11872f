// Random fabrics: independent logarithms, uniform within a box.
//
// The default box is wide: it holds vegan leather as well as chiffon. A flexural rigidity B is
// drawn and then shared by weft, warp and bias with a factor of anisotropy each; B is about 4.15
// k_b on isotropic meshes (see bending.h).
#pragma once

#include "core/fabric.h"
#include "core/random.h"

namespace drape {

/// From `low` to `high`.
struct Interval {
  double low, high;
};

/// Logarithms are uniform, threshold controls themselves.
struct FabricBox {
  Interval areal_density{0.05, 0.4};       ///< [kg/m^2]
  Interval stretch{200, 5000};             ///< k_u and k_v, each [N/m]
  Interval shear{10, 500};                 ///< k_h [N/m]
  Interval flexural_rigidity{1e-6, 2e-4};  ///< mean B [N m]
  Interval anisotropy{0.5, 2};             ///< factor on each k_b [1]
  Interval past_threshold{1, 1};           ///< s_b, each [1]
  Interval threshold{0.3, 0.3};            ///< t_b, each [1]
};

/// One fabric of the box; takes fourteen numbers from `random`.
Fabric random_fabric(Random& random, const FabricBox& box = {});

}  // namespace drape
