// Start protocols: which of the many equilibria of a fabric a drape is.
//
// A fabric has many stable drapes, so a result always names how its branch was chosen:
//   coarse_ramp gravity grows from 0.02 g to g in 8 geometric steps, from flat with 1e-6 m of
//   noise,
//               on the coarse mesh (coarse_level.h); then solved on the mesh itself
//   lobes       from a folded state with a given number of lobes, on the coarse mesh and with a
//               membrane that is soft at first; then solved on the mesh itself
//   ramp        gravity grows as above, in 16 careful steps on the mesh itself: the reference
//   lowering    an annular plate under the overhang sinks, as the instrument's does (lowering.h)
//   guided      minimised under a guide from meridian arcs that end at an observed outline, which
//   is
//               then let go (guide.h, guided.h)
//   ensemble    several of these starts (ensemble.h)
// A mesh without a coarse level is its own coarse mesh.
#pragma once

#include <cstdint>
#include <string>

#include "core/equilibrium.h"
#include "core/potential.h"
#include "core/scene.h"

namespace drape {

/// Drapes by the gravity ramp on the coarse mesh. The potential is copied, its guide ignored.
/// Counts and times are those of both meshes. result.protocol: "coarse_ramp".
Equilibrium drape_by_coarse_ramp(const Potential& potential, std::uint64_t seed,
                                 const EquilibriumOptions& options = {});

/// Drapes by the gravity ramp on the mesh itself. The potential is copied, its guide ignored.
/// result.protocol: "ramp". Counts and times are those of the whole ramp.
Equilibrium drape_by_ramp(const Potential& potential, std::uint64_t seed,
                          const EquilibriumOptions& options = {});

/// The flat rest state with kStartNoise at the free vertices: exactly flat is a saddle. State 3n.
inline constexpr double kStartNoise = 1e-6;  // [m]
VecX noisy_flat_state(const Mesh& mesh, std::uint64_t seed);

/// A start with `lobes` sinusoidal folds around the support; phase [rad] turns them. State 3n.
VecX folded_state(const Mesh& mesh, const Scene& scene, int lobes, double phase);

/// The equilibrium from x (3n), first with a membrane so soft that the overhang's weight strains it
/// by some per cent, then with stiffer ones up to the fabric's own: a stiff membrane follows its
/// folds in tiny steps and buckles on the way. Guide and support act as in the potential.
Equilibrium solve_stiffening(Potential potential, const Scene& scene, const VecX& x,
                             const EquilibriumOptions& options = {});

/// Drapes from folded_state on the coarse mesh, without a guide; result.protocol: "lobes(n,
/// phase)". Counts and times are those of both meshes.
Equilibrium drape_by_lobes(const Potential& potential, const Scene& scene, int lobes, double phase,
                           const EquilibriumOptions& options = {});

/// A start whose rim ends at an outline r_obs(alpha): every meridian is a circular arc of the
/// overhang's length, tangent to the support, and the meridians are spread so that equal rest
/// lengths of the rim get equal arc lengths of the outline. State 3n.
VecX state_from_outline(const Mesh& mesh, const Scene& scene, const Guide& guide);

}  // namespace drape
