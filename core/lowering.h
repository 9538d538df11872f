// Drape by lowering a plate, as the instrument does it: the specimen lies flat on the support and
// on a plate around it; the plate sinks until nothing touches it any more.
//
// The state follows the plate as an equilibrium at every height. A step is predicted from the last
// one; where the state leaves its prediction by more than a wrinkle the step is halved, down to
// 1/64 of the largest one, so that a snap happens at the height where it belongs. Measured on 600
// vertices with largest steps of 1, 2 and 4 mm: at k_b = 2e-5 N m two drapes (drape
// coefficient 92.1 and 92.2), at 1e-5 one and the same, at 2.5e-6 three (55.0 to 55.8, energies
// within 0.9 %, all below the gravity ramp's); at 7.5e-7 three (72 to 78), 40 to 46 % above the
// gravity ramp in energy: on a plate without friction, and without self-contact, a soft cloth tucks
// into pleats that it cannot leave again.
#pragma once

#include <cstdint>

#include "core/equilibrium.h"
#include "core/potential.h"

namespace drape {

struct LoweringOptions {
  double largest_step = 2e-3;  ///< of the plate [m]
  std::uint64_t seed = 1;      ///< of the noise of 1e-6 m on the flat start
};

/// The potential is copied, its guide and plate ignored. result.protocol: "lowering". Counts and
/// times are those of the whole way; a failure on the way is the status of the result. Throws
/// std::invalid_argument unless largest_step > 0.
Equilibrium drape_by_lowering(const Potential& potential, const LoweringOptions& lowering = {},
                              const EquilibriumOptions& options = {});

}  // namespace drape
