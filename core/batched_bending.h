// The bending energy of bending.h, its gradient and its Hessian for all wings of a mesh, kLanes at
// a time.
//
// With the edge e = x1 - x0 of length l and, per side, the normal n = e x a towards the apex
// x0 + a (b x e on the right), the fold angle is delta = atan2(l n_r . a, n_l . n_r).
// Its Hessian is a closed form: per side with unit normal n, in-plane unit normal m of the edge
// towards the apex c, N = twice the area, s0 = (x_c - x1) . e / l and s1 = -(x_c - x0) . e / l,
//   d2(delta)_ij = sum over sides [n A_ij^T + A_ji n^T],   A_ij = M_ij m + Q_ij e / l
//   M_11 = -s1^2/N^2 - 1/(2 l^2), M_1c = -s1 l/N^2, M_cc = -l^2/N^2, Q_11 = -s1/(l N), Q_1c = -1/N
// and what belongs to x0 follows because a translation changes nothing.
#pragma once

#include <vector>

#include "core/bending.h"
#include "core/element_batches.h"

namespace drape {

/// The laws of kLanes wings; stiffness 0 in the lanes that fill up.
struct WingLawBatch {
  Lanes stiffness, scale, threshold;
};

/// E [J], dE/d(delta) [J/rad] and d2E/d(delta)2 [J/rad^2] of kLanes wings at the fold angle delta.
/// On the threshold the tangent has its value past it; it is never negative.
struct WingResponse {
  WingResponse(const WingLawBatch& law, BendingLaw kind, const Lanes& delta) {
    using std::experimental::abs, std::experimental::copysign, std::experimental::max,
        std::experimental::min;
    const Lanes d = abs(delta);
    const Lanes factor = select(d >= law.threshold, law.scale, Lanes(1.0));
    tangent = 2.0 * law.stiffness * factor;
    if (kind == BendingLaw::secant) {
      energy = law.stiffness * factor * d * d;
      moment = tangent * delta;
    } else {
      const Lanes up_to = min(d, law.threshold), beyond = max(d - law.threshold, Lanes(0.0));
      energy = law.stiffness * (up_to * up_to + beyond * (2.0 * up_to + law.scale * beyond));
      moment = copysign(2.0 * law.stiffness * (up_to + law.scale * beyond), delta);
    }
  }
  Lanes energy, moment, tangent;
};

/// The laws of a mesh's wings, in the order of their batches.
std::vector<WingLawBatch> batches_of_laws(const std::vector<WingBatch>& batches,
                                          const std::vector<WingLaw>& laws);

/// All wings of a potential: their laws share the reading of the model.
struct WingSet {
  const std::vector<WingBatch>& batches;
  const std::vector<WingLawBatch>& laws;
  BendingLaw law;
};

/// Energy [J].
double bending_energy(const WingSet& wings, const PaddedState& x);

/// Adds dE/dx [N] to the gradient and returns the energy [J].
double add_bending_gradient(const WingSet& wings, const PaddedState& x, PaddedState& gradient);

/// Adds d2E/dx2 [N/m] to the values of a Hessian: E'' d d^T, which is never negative, and
/// (1 - blend) E' d2(delta)/dx2, the geometric part.
void add_bending_hessian(const WingSet& wings, const std::vector<WingPlaces>& places,
                         const PaddedState& x, double blend, double* values);

}  // namespace drape
