// The adjoint gradient of a functional of the equilibrium: one solve for all parameters.
//
// At an equilibrium g(x, p) = dE/dx = 0, so H dx/dp = -dg/dp. For L(x): solve H lambda = -dL/dx
// with the factor of the true Hessian that the equilibrium carries; then dL/dp = lambda^T dg/dp.
#pragma once

#include "core/equilibrium.h"
#include "core/potential.h"

namespace drape {

/// Throws std::invalid_argument unless the equilibrium is a converged, certified minimum of this
/// potential's size: elsewhere the implicit function theorem says nothing.
void require_minimum(const Potential& potential, const Equilibrium& equilibrium);

/// dL/dp for all thirteen parameters (natural units, order of Parameter) from dL/dx (3n). The
/// potential must be the one, fabric and guide included, whose equilibrium this is.
ParameterVector adjoint_gradient(const Potential& potential, const Equilibrium& equilibrium,
                                 const VecX& dL_dx);

}  // namespace drape
