// A drape is settled where its own outline leads back to it.
//
// On a mesh a stiff membrane holds single vertices near the feet of folds, popped to one side or
// the other, and a protocol that passes many folds ends with some of them where they do not belong.
// From the outline of such a drape a guided start (guided.h), whose membrane is soft first, leads
// to another drape of nearly that outline and mostly less energy (how often: README, "Which
// drape"). Parameters can be told from an outline alone only where the drape is the one that it
// leads to.
#pragma once

#include "core/equilibrium.h"
#include "core/potential.h"
#include "core/scene.h"

namespace drape {

struct SettlingOptions {
  double same_distance = 1e-5;  ///< no vertex of a settled drape moves further [m]
  int rounds = 12;
};

/// Follows the outline of `drape` to the drape it leads to, and so on, until one is its own. Where
/// the rounds do not suffice, or end in a circle or a failure, the result is the lowest in energy
/// of all of them. result.protocol: that of `drape` with ", settled" or ", unsettled". Counts and
/// times are those of the whole way. A drape that is no equilibrium is returned as it is. The
/// potential's guide is ignored.
Equilibrium settle(const Potential& potential, const Scene& scene, Equilibrium drape,
                   const EquilibriumOptions& options = {}, const SettlingOptions& settling = {});

}  // namespace drape
