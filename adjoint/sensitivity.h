// Forward sensitivities dx/dp = -H^-1 dg/dp of an equilibrium: one solve a parameter.
//
// They make the Gauss-Newton Jacobian of a profile, predict the equilibrium of a near-by fabric,
// and are the second route to every adjoint gradient: (d rho/dp)^T dL/d rho must equal it to
// rounding.
#pragma once

#include <vector>

#include "core/equilibrium.h"
#include "core/outline.h"
#include "core/potential.h"
#include "core/profile.h"

namespace drape {

/// dx/dp (3n x parameters.size(), natural units). Throws like adjoint_gradient.
MatX sensitivities(const Potential& potential, const Equilibrium& equilibrium,
                   const std::vector<Parameter>& parameters);

/// d rho/dp (kProfileSize x columns of dx_dp) of the profile of `outline` about `centre`.
MatX profile_sensitivities(const Outline& outline, const Profile& profile, const Vec2& centre,
                           const VecX& x, const MatX& dx_dp);

}  // namespace drape
