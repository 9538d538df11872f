// Random bending behaviour as measured: areal density with rigidity in three directions, and
// softening with curvature.
//
// (ln density, ln B_warp, ln B_weft, ln B_bias) are jointly normal, fitted to the 618 fabrics of
// Feng et al. 2022 (doi 10.1145/3550454.3555464).
#pragma once

#include "core/fabric.h"
#include "core/random.h"
#include "core/types.h"

namespace drape {

struct MeasuredBending {
  double areal_density;  ///< [kg/m^2]
  Vec3 rigidity;         ///< B of weft, warp, bias [N m]
};

/// Density and rigidity together, truncated to the measured range. Takes any number of values from
/// `random`, as do the functions below.
MeasuredBending random_bending(Random& random);

/// The rigidity (weft, warp, bias) [N m] of a fabric whose density is known: log-normal about the
/// regression on the density. `shift` is added to the logarithms; their deviations from the
/// regression are `scatter` times the measured ones (0: the regression itself).
Vec3 random_rigidity(double areal_density, double shift, double scatter, Random& random);

/// Sets k_b to what comes closest to a rigidity (weft, warp, bias), each at least a hundredth of
/// the largest: where non-negative least squares ask for zero, which no fabric allows.
void set_rigidity(Fabric& fabric, const Vec3& rigidity);

/// Sets s_b and t_b (in the reading "radius"): two slopes in place of the measured curve.
void set_random_softening(Fabric& fabric, Random& random);

}  // namespace drape
