// Ceres on the objective of a fit: Levenberg-Marquardt with its Jacobian, or BFGS with its gradient
// (of a DrapeObjective: by sensitivities, by the adjoint).
#pragma once

#include <string>

#include "estimation/fit_objective.h"

namespace drape {

enum class FitMethod { levenberg_marquardt, bfgs };

struct MinimiseOptions {
  FitMethod method = FitMethod::levenberg_marquardt;
  int max_iterations = 60;
  double function_tolerance = 1e-9;   ///< relative change of the cost
  double parameter_tolerance = 1e-7;  ///< relative change of the unknowns
  double sufficient_cost = 1e-5;      ///< costs below are far inside the noise: done
  VecX lower, upper;                  ///< bounds on u; a BFGS step that leaves them is shortened
};

struct Minimum {
  VecX u;
  double initial_cost = 0, cost = 0;
  int iterations = 0;
  bool converged = false;  ///< a tolerance was met, and not for want of drapes to step to
  std::string message;     ///< Ceres' own words, but at an edge
};

/// Minimises the objective from u, where it must have a value.
Minimum minimise(FitObjective& objective, const VecX& u, const MinimiseOptions& options);

}  // namespace drape
