// Solutions of mechanics problems that know nothing of this project's energies or meshes: ordinary
// differential equations and closed forms that drapes are validated against.
//
// Bent strips: heavy elastica with the moment of a strip that may curve across (Ashwell 1950; Fung
// and Wittrick 1955). Hanging strips: one-dimensional equilibrium with the finite-strain law of
// model Eqs. 1 and 2. Annular plate: Kirchhoff. All isotropic in bending.
#pragma once

#include <functional>

#include "core/types.h"

namespace drape::reference {

/// Bending of a strip: rigidity of a wide plate B [N m], Poisson's ratio nu, width W [m], uniaxial
/// stretch modulus E of the strip [N/m]. A narrow or little bent strip curves across freely,
/// M = (1 - nu^2) B kappa; a wide or strongly bent one is kept cylindrical, M = B kappa. Width 0:
/// the plate, B kappa.
struct StripSection {
  double B, nu = -1.0 / 3, width = 0, modulus = 0;
};

/// Moment per width at curvature kappa >= 0 [N]: the derivative of the bending energy per area,
/// least over the shapes across.
double moment(const StripSection& section, double kappa);

/// End of a strip clamped horizontally.
struct Tip {
  double drop, reach;  ///< below and out from the clamp line [m]
};

/// Heavy elastica, dM/ds = -q (L - s) cos theta, theta(0) = 0, M(L) = 0, by shooting from the tip
/// with Runge and Kutta's method; q: weight per area [N/m^2], L: length [m].
Tip heavy_elastica(const StripSection& section, double q, double length);

/// Stretch stiffnesses of the model [N/m].
struct Stretch {
  double k_u, k_v, k_h;
};

/// Small-strain uniaxial modulus with free contraction, at `angle` from u [N/m]: the reciprocal of
/// S_11 c^4 + S_22 s^4 + (2 S_12 + 1/G) c^2 s^2 with C_11 = k_u + k_h/2, C_22 = k_v + k_h/2,
/// C_12 = G = k_h/2.
double uniaxial_modulus(const Stretch& k, double angle);

/// Stretch ratio at `angle` from u under the force per rest width N [N/m], contraction and shear
/// free, large strains.
double uniaxial_stretch(const Stretch& k, double angle, double N);

/// Displacement along the strip at distance s from the clamp of a strip of length L that hangs
/// under its weight: the integral of uniaxial_stretch - 1 at N = q (L - s) [m].
double hanging_displacement(const Stretch& k, double angle, double q, double length, double s);

/// Deflection at the rim r = b of an annular plate clamped at r = a, free at b, under a uniform
/// load q (Kirchhoff): w = q r^4 / (64 B) + c0 + c1 ln r + c2 r^2 + c3 r^2 ln r [m].
double annulus_sag(double B, double q, double a, double b, double nu);

}  // namespace drape::reference
