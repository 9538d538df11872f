// Drape guided by an observed outline: the start is laid along it, minimised under a guide, and the
// guide is released step by step. The outline names the branch; the drape owes it nothing else.
#pragma once

#include <vector>

#include "core/equilibrium.h"
#include "core/potential.h"
#include "core/scene.h"

namespace drape {

/// The equilibrium under one guide, from the meridians that end at its outline. No drape yet.
/// result.protocol: "guided".
Equilibrium solve_under_guide(const Potential& potential, const Scene& scene, const Guide& guide,
                              const EquilibriumOptions& options = {});

/// The same, chosen on the coarse mesh (coarse_choice.h).
Equilibrium solve_under_guide_from_coarse(const Potential& potential, const Scene& scene,
                                          const Guide& guide,
                                          const EquilibriumOptions& options = {});

/// Under guide.kappa = each of `kappas` in turn, the first from the meridians and each from the one
/// before, then without a guide. The guided ones are solved loosely. Counts and times are those of
/// the whole way; a failure on the way is the status of the result. Throws std::invalid_argument
/// when `kappas` is empty.
Equilibrium drape_guided(const Potential& potential, const Scene& scene, Guide guide,
                         const std::vector<double>& kappas, const EquilibriumOptions& options = {});

}  // namespace drape
