// Ensemble: many starts and all the distinct drapes they end in.
//
// A fabric has many stable drapes; an ensemble answers "which?" by listing them instead of choosing
// one. Two states are one minimum when no vertex lies further apart than a distance; nothing is
// factored out, since mesh and fabric know directions. Two minima are one shape when their profiles
// agree up to a symmetry of the fabric.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/equilibrium.h"
#include "core/fabric.h"
#include "core/potential.h"
#include "core/scene.h"

namespace drape {

struct EnsembleOptions {
  int ramps = 3;  ///< gravity ramps with noise of different seeds
  int fewest_lobes = 3, most_lobes = 9;
  int phases = 3;               ///< of every lobe count, spread over one lobe
  int flats = 5;                ///< minimised from flat with noise of different seeds
  double same_distance = 1e-4;  ///< largest vertex distance within one minimum [m]
  std::uint64_t seed = 1;       ///< of all noise
};

/// One start of an ensemble.
struct EnsembleStart {
  enum class Kind { ramp, lobes, flat };
  Kind kind;
  int lobes = 0;
  double phase = 0;        ///< [rad]
  std::uint64_t seed = 0;  ///< of ramp and flat

  std::string name() const;  ///< as "ramp(seed 2)"
};

/// Throws std::invalid_argument when there is none.
std::vector<EnsembleStart> ensemble_starts(const EnsembleOptions& options);

/// The drape from one start; result.protocol is the start's name.
Equilibrium drape_from(const Potential& potential, const Scene& scene, const EnsembleStart& start,
                       const EquilibriumOptions& options = {});

/// The drape with the lowest energy from all starts, one after the other; result.protocol names the
/// ensemble and that start. Counts and times are those of all. When none converges: the last one.
Equilibrium lowest_of_ensemble(const Potential& potential, const Scene& scene,
                               const EnsembleOptions& ensemble,
                               const EquilibriumOptions& options = {});

/// States that are one minimum.
struct MinimumGroup {
  size_t representative;        ///< index of the state with the lowest energy
  std::vector<size_t> members;  ///< all indices, the representative's included
};

/// Groups of states (3n each) within `distance` [m] of their representative, lowest energy first.
/// Throws std::invalid_argument unless there is an energy a state.
std::vector<MinimumGroup> merge_minima(const std::vector<VecX>& states,
                                       const std::vector<double>& energies, double distance);

/// Number of profiles (kProfileSize radii each) that differ by more than `rms` [m] under every
/// symmetry of the fabric: half a turn and mirrors at weft and warp, or any turn and mirror where
/// stretch and bending are the same in all directions that can be told apart.
int distinct_shapes(const std::vector<VecX>& profiles, const Fabric& fabric, double rms = 5e-4);

}  // namespace drape
