// The two distributions of fabrics that a solver must cope with.
//
// measured: density, rigidity and softening of the 618 fabrics of Feng et al. 2022
//   (measured_bending.h). Stretch and shear span knits to coated fabrics, softening is that of
//   their bending tests.
// wide: a log-uniform box up to what is still a cloth: density .02 to 1 kg/m^2 (chiffon to rug),
//   stretch 5 to 1e5 N/m and shear 1 to 1e4 N/m (loose knit to laminated sailcloth; weft and warp
//   drawn apart), B 1e-8 to 1e-2 N m (gauze to thick leather: 20 times below and above what was
//   measured), its directions apart by up to 10, s_b .05 to 2, t_b 0 to 1. The bending length is at
//   least 2 mm; the shortest measured one is 8.6 mm. On a mesh of 5 mm a stretch stiffness is then
//   up to 1e9 times a bending stiffness (k h^2 / k_b).
#pragma once

#include <string_view>

#include "core/fabric.h"
#include "core/random.h"

namespace drape {

enum class FabricDistribution { measured, wide };
std::string_view name(FabricDistribution distribution);

/// Takes any number of values from `random`: one generator a fabric.
Fabric random_fabric(Random& random, FabricDistribution distribution);

/// (B / (density g))^(1/3) [m], with B the mean of weft, warp and bias below the threshold. It sets
/// the size of the folds.
double bending_length(const Fabric& fabric, double gravity);

}  // namespace drape
