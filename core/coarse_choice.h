// A state is chosen on the coarse mesh of a specimen (coarse_level.h) and then solved on the mesh
// itself, which sees only the end of the way.
#pragma once

#include <functional>

#include "core/equilibrium.h"
#include "core/potential.h"

namespace drape {

/// Finds a state of a potential; the second argument are the options to solve with.
using Choice = std::function<Equilibrium(const Potential&, const EquilibriumOptions&)>;

/// The equilibrium from the state that `choose` finds on the coarse mesh, under the same fabric,
/// guide and support. Without a coarse level `choose` has the mesh itself. Counts and times are
/// those of both; a failed choice is the result, restated on the mesh itself.
Equilibrium chosen_on_coarse_mesh(const Potential& potential, const EquilibriumOptions& options,
                                  const Choice& choose);

/// A failure at less gravity, with a softer membrane or on another mesh ends a protocol: what is
/// said of its state is to be true of the potential asked for. A success is returned as it is.
Equilibrium restated(const Potential& potential, Equilibrium result);

}  // namespace drape
