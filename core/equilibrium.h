// Static equilibrium: a stable minimum of the total potential.
//
// L-BFGS whose initial matrix is a Cholesky factor of the blended Hessian H(a), that is the Hessian
// with its negative geometric parts scaled by 1 - a. The factor is refreshed rarely: it costs as
// much as fifteen iterations. Far from equilibrium a = 1, which always has a factor; near it a is
// as small as the factorisation allows, so that the end is Newton's own. A state counts as
// converged when its residual is at most the tolerance (or the rounding floor, whichever is larger)
// and the true Hessian has a Cholesky factor: the certificate that it is a minimum. At a saddle the
// solver leaves along a direction of negative curvature; where nothing leads down and there is no
// equilibrium either, as before a jump of the energy, it takes a few steps uphill.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/potential.h"
#include "core/sparse_factor.h"

namespace drape {

struct EquilibriumOptions {
  double tolerance = 1e-8;     ///< on the relative residual (see Potential::residual)
  int max_iterations = 20000;  ///< over all saddles
  double largest_move = 0.02;  ///< of a vertex in one iteration [m]
  bool certify = true;         ///< factor the true Hessian at the end and leave saddles
  /// Called after every iteration with the state and its gradient (3n); false ends the solve like
  /// max_iterations does. May be empty.
  std::function<bool(const VecX& x, const VecX& gradient)> go_on = nullptr;

  /// For a state on the way to another: a residual of `residual` will do, not certified.
  EquilibriumOptions loosened(double residual) const {
    EquilibriumOptions loose = *this;
    loose.tolerance = std::max(residual, tolerance);
    loose.certify = false;
    return loose;
  }
};

enum class EquilibriumStatus {
  converged,        ///< residual within tolerance (or at the rounding floor), certified minimum
  saddle,           ///< residual within tolerance, but no way down was found from a saddle
  stagnated,        ///< no further decrease, residual above tolerance and rounding floor
  iteration_limit,  ///< max_iterations reached, or stopped by go_on
  non_finite,       ///< the energy or its derivatives are not finite at the start
};
std::string_view name(EquilibriumStatus status);

struct Equilibrium {
  VecX x;  ///< 3n [m]
  EquilibriumStatus status = EquilibriumStatus::non_finite;
  double residual = 0;        ///< largest nodal force over largest nodal weight
  double rounding_floor = 0;  ///< of that residual, measured at x (0 if not needed)
  double energy = 0;          ///< [J]
  int newton_iterations = 0;  ///< preconditioned L-BFGS iterations
  int factorizations = 0;
  int negative_eigenvalues = -1;  ///< of the true Hessian at x: 0 certified; -1 not known
  double cpu_seconds = 0;         ///< of this thread
  std::string protocol;           ///< how the start was chosen, see drape_protocol.h
  /// Factor of the true Hessian at x; null unless converged and certified. Not for two threads at
  /// a time.
  std::shared_ptr<const SparseFactor> factor;
  /// The last factor there was, to start a solve near by; `factor` where that is not null.
  std::shared_ptr<const SparseFactor> preconditioner;

  /// Adds the counts and times of solves that led here.
  void add_work_of(const Equilibrium& earlier) {
    newton_iterations += earlier.newton_iterations;
    factorizations += earlier.factorizations;
    cpu_seconds += earlier.cpu_seconds;
  }

  /// Counts and times become those of `all` the solves that led here, this one among them.
  void set_work_of(const Equilibrium& all) {
    newton_iterations = all.newton_iterations;
    factorizations = all.factorizations;
    cpu_seconds = all.cpu_seconds;
  }

  bool converged() const { return status == EquilibriumStatus::converged; }
};

/// Minimises the potential from x (3n); fixed vertices stay where they are. `nearby`: the
/// preconditioner of a solve on this mesh that ended near x, if there is one; a re-solve after a
/// small change then needs no factorisation but the last. Never throws on numerical failure: see
/// status.
Equilibrium solve_equilibrium(const Potential& potential, const VecX& x,
                              const EquilibriumOptions& options = {},
                              std::shared_ptr<const SparseFactor> nearby = nullptr);

/// Smallest eigenvalue of the true Hessian at a converged equilibrium [N/m].
double smallest_eigenvalue(const Equilibrium& equilibrium);

}  // namespace drape
