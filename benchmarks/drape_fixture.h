// The drapes that the benchmarks work on: a fabric of medium stiffness in both bending regimes, on
// the standard instrument, solved once a size and kept. That first solve is not measured.
#pragma once

#include <memory>

#include "core/drape_protocol.h"
#include "core/outline.h"
#include "core/potential.h"

namespace drape::bench {

inline const Scene kScene;
inline constexpr int kLobes = 6;

Fabric medium_fabric();

/// The same object for the same number of vertices.
std::shared_ptr<const Discretization> disc(int vertices);

struct SolvedDrape {
  Potential potential;
  Equilibrium equilibrium;  ///< certified, with its factor
  Outline outline;
};

/// Solved at the first call for a number of vertices. Throws std::runtime_error if that fails.
const SolvedDrape& solved_drape(int vertices);

}  // namespace drape::bench
