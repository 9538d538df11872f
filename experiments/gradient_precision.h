// The gradient of an outline loss by different methods, with its error, CPU time and memory; and
// what becomes of it near a limit point, where the branch that it belongs to ends.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>

#include "core/equilibrium.h"
#include "core/potential.h"
#include "experiments/progress.h"
#include "experiments/settings.h"

namespace drape {

/// One step of a fit: the drape of a fabric is to be found from that of one whose bending is ten
/// per cent stiffer and whose outline is the observed one, with the gradient of
/// L = 1/2 mean over 360 directions of (rho - rho_obs)^2 by log parameters.
struct GradientProblem {
  /// Throws std::runtime_error if there is no such drape.
  GradientProblem(const Settings& settings, std::shared_ptr<const Discretization> discretization);

  const Settings& settings;
  Potential potential;
  VecX start;                     ///< 3n [m]
  VecX observed;                  ///< kProfileSize radii [m]
  VecX reference;                 ///< gradient by the adjoint at the rounding floor
  double reference_disagreement;  ///< of extrapolated differences from it, as an error below
};

/// Every method at every setting: {"method", "setting", "error", "cpu_seconds", "memory_bytes",
/// "status"}; the error is the largest of an entry over the largest entry of the reference. CPU
/// time and memory are those of the solve from the start and of the derivative.
nlohmann::ordered_json measure_gradients(const GradientProblem& problem, Progress& progress);

/// How many of these there are.
int gradient_measurements(const GradientPrecisionSettings& study);

/// The first snap of at least a millimetre at a limit point, on the way to a stiffer bending: how
/// the framework ends the branch there, and on both sides, at the distances of the settings, the
/// derivative of the drape coefficient by the log stiffness, its error and that of differences, the
/// largest velocity of a vertex and the smallest eigenvalue. "status": "found" or why not.
nlohmann::ordered_json gradient_at_snap(const Settings& settings,
                                        std::shared_ptr<const Discretization> discretization,
                                        Progress& progress);

}  // namespace drape
