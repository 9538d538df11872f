// Equilibria that are hard to find for any method: what each of them is made of.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/potential.h"
#include "experiments/settings.h"

namespace drape {

struct Problem {
  Potential potential;
  VecX start;  ///< 3n
};

/// vanishing_bending     k_b of 1e-12 N m
/// ratio_1e8             a membrane 1e8 times as stiff as the bending (see make_fabric)
/// needles               triangles of a height of 1e-3 of their longest edge
/// threshold_softening   bending that drops to a twentieth past a threshold in the midst of a fold
/// threshold_stiffening  and one that grows twentyfold, so that wings gather on the threshold
/// secant                the bending law whose energy jumps
/// near_snap             just before the end of a branch: an almost singular Hessian
const std::vector<std::string>& hard_cases();

/// The medium fabric of the study with stretch stiffness membrane_to_bending * B / l^2, B its
/// flexural rigidity and l the overhang, and a shear stiffness in proportion.
Fabric make_fabric(const Scene& scene, double membrane_to_bending, double areal_density);

/// One of them on a mesh of that many vertices. Throws std::runtime_error if no snap is found.
Problem hard_case(const std::string& name, const Settings& settings, int vertices);

}  // namespace drape
