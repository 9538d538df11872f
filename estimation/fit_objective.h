// What a minimiser sees of a fit: J(u) = 1/2 |r(u)|^2 where the drapes of u are known.
#pragma once

#include "core/types.h"

namespace drape {

class FitObjective {
 public:
  virtual ~FitObjective() = default;

  virtual int unknowns() const = 0;
  virtual int residuals() const = 0;
  /// r and, if wanted, its Jacobian (residuals x unknowns). False where there is no value.
  virtual bool residuals_at(const VecX& u, VecX& r, MatX* jacobian) = 0;
  /// J and, if wanted, its gradient. False likewise.
  virtual bool cost_at(const VecX& u, double& cost, VecX* gradient) = 0;
  /// Whether the last new u had no value. A minimiser that shrinks its steps because of this has
  /// not converged.
  virtual bool refused() const = 0;
  /// Whether a new u next to one that has a value had none: there is nothing to step to.
  virtual bool at_edge() const = 0;
};

}  // namespace drape
