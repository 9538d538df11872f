// The gradient of a loss checked on one fabric: adjoint against differences of re-solved equilibria
// and against the tangent.
//
// Derivatives are with respect to log parameters (t_b linear). The difference f is central; both of
// its states start from the prediction x +- dx/dp h and are solved to the rounding floor. A step is
// excluded when a wing changes its bending regime between the three states, or when a state lies
// far from its prediction (it snapped to another branch): there the loss has no derivative to
// compare with. Large steps err by truncation, small ones by rounding; two steps together give a
// difference without the truncation of second order (Richardson 1911), which helps where a
// derivative is small against its own higher ones. The best of all these counts.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/discretization.h"
#include "core/records.h"
#include "experiments/settings.h"

namespace drape {

struct ParameterCheck {
  Parameter parameter;
  double adjoint = 0;               ///< dL/dp by the adjoint
  std::vector<double> differences;  ///< central difference of each step; NaN if excluded
  /// Of each step and the one before it, extrapolated; the first one NaN, as those excluded.
  std::vector<double> extrapolated;
  double difference = 0;  ///< the nearest to the adjoint; NaN if all were excluded
  double step = 0;        ///< its step, the smaller one of two
  double error = 0;       ///< |a - f| / max(|f|, 1e-4 max_j |f_j|); NaN likewise
  int excluded = 0;       ///< steps with a regime switch or a snap inside
};

struct GradientCheck {
  std::string status;  ///< "ok" or why nothing could be checked
  std::vector<ParameterCheck> parameters;
  double adjoint_versus_tangent = 0;  ///< largest |a - t| / max(|a|, 1e-4 max_j |a_j|)
  double forward_cpu_seconds = 0;     ///< of the cold drape
  double adjoint_cpu_seconds = 0;     ///< of outline, loss and adjoint gradient, given the factor
  double unit_cpu_seconds = 0;        ///< see factorization_unit.h
  int wings = 0, wings_past_threshold = 0;
  Record record;  ///< of the drape at which the gradient was checked
};

/// Drapes the fabric and checks the gradient of settings.gradient_check.loss there. `seed`: of the
/// observation that the loss compares with. Failed solves are told by `status`.
GradientCheck check_gradient(const Settings& settings,
                             std::shared_ptr<const Discretization> discretization,
                             const Fabric& fabric, std::uint64_t seed);

}  // namespace drape
