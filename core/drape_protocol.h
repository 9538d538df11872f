// Start protocols: which of the many equilibria of a fabric a drape is.
//
// A fabric has many stable drapes, so a result always names how its branch was chosen:
//   ramp   gravity grows from 0.02 g to g in 16 geometric steps, from flat with 1e-6 m of noise
//   lobes  minimised from a folded state with a given number of lobes
//   guided minimised under a guide from meridian arcs that end at an observed outline (guided.h)
//   lowering  a plate under the flat specimen sinks until nothing touches it (lowering.h)
//   ensemble  the lowest in energy from many starts, with all the others (ensemble.h)
#pragma once

#include <cstdint>
#include <string>

#include "core/equilibrium.h"
#include "core/potential.h"
#include "core/scene.h"

namespace drape {

/// Drapes by the gravity ramp. The potential is copied, its guide ignored.
/// result.protocol: "ramp". Counts and times are those of the whole ramp.
Equilibrium drape_by_ramp(const Potential& potential, std::uint64_t seed,
                          const EquilibriumOptions& options = {});

/// A start with `lobes` sinusoidal folds around the support; phase [rad] turns them. State 3n.
VecX folded_state(const Mesh& mesh, const Scene& scene, int lobes, double phase);

/// Drapes from folded_state; result.protocol: "lobes(n, phase)".
Equilibrium drape_by_lobes(const Potential& potential, const Scene& scene, int lobes, double phase,
                           const EquilibriumOptions& options = {});

/// A start whose rim ends at an outline r_obs(alpha): every meridian is a circular arc of the
/// overhang's length, tangent to the support, and the meridians are spread so that equal rest
/// lengths of the rim get equal arc lengths of the outline. State 3n.
VecX state_from_outline(const Mesh& mesh, const Scene& scene, const Guide& guide);

}  // namespace drape
