// A solved drape in both bending regimes, and its equilibrium for fabrics near by.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/drape_protocol.h"
#include "core/outline.h"
#include "tests/support/shapes.h"

namespace drape::test {

struct SolvedDrape {
  explicit SolvedDrape(double tolerance_ = 1e-11)
      : tolerance(tolerance_),
        potential(disc(300), medium_fabric(), {BendingLaw::tangent, BendingThreshold::radius},
                  kCusick.gravity),
        equilibrium(drape_by_lobes(potential, kCusick, 5, 0.1, {.tolerance = tolerance})),
        outline(trace_outline(potential.mesh(), kCusick, equilibrium.x)) {
    if (!equilibrium.converged()) throw std::runtime_error(std::string(name(equilibrium.status)));
  }

  /// Equilibrium of another fabric on the same branch.
  Equilibrium solve(const Fabric& fabric) const {
    Potential other = potential;
    other.set_fabric(fabric);
    return solve_equilibrium(other, equilibrium.x, {.tolerance = tolerance});
  }

  double tolerance;
  Potential potential;
  Equilibrium equilibrium;
  Outline outline;
};

/// The fabric whose parameters are p (1 + t d), entry by entry.
inline Fabric scaled(const Fabric& fabric, const ParameterVector& d, double t) {
  return to_fabric(to_vector(fabric).cwiseProduct(ParameterVector::Ones() + t * d));
}

}  // namespace drape::test
