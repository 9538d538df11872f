// Losses of a drape's outline, each with its exact derivative with respect to the outline's
// corners.
//
//   profile:           L = 1/2 mean over 360 directions of (rho(alpha) - rho_obs(alpha))^2   [m^2]
//   coverage:          L = 1/2 sum over pixels of (c - c_obs)^2 times the area of a pixel    [m^2]
//   drape coefficient: L = DC itself (Cusick), a functional to differentiate rather than a misfit
//
// Chain: corners -> (outline.h, pull_back) -> state -> (adjoint.h) -> parameters.
#pragma once

#include "core/coverage.h"
#include "core/outline.h"
#include "core/profile.h"

namespace drape {

struct Loss {
  double value;
  Points2 dL_dpoints;  ///< one row a corner of the outline
};

/// observed: kProfileSize radii about `centre` [m], the observation's origin in the drape's frame.
Loss profile_loss(const Outline& outline, const VecX& observed, const Vec2& centre = Vec2::Zero());

Loss coverage_loss(const Outline& outline, const PixelGrid& grid, const CoverageImage& observed);

Loss drape_coefficient_loss(const Outline& outline, const Scene& scene);

}  // namespace drape
