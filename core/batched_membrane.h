// The membrane energy of membrane.h, its gradient and its Hessian for all triangles of a mesh,
// kLanes at a time.
#pragma once

#include <vector>

#include "core/element_batches.h"
#include "core/membrane.h"

namespace drape {

/// Energy [J]; not finite for a collapsed triangle.
double membrane_energy(const std::vector<TriangleBatch>& batches, const MembraneStiffness& k,
                       const PaddedState& x);

/// Adds dE/dx [N] to the gradient and returns the energy [J].
double add_membrane_gradient(const std::vector<TriangleBatch>& batches, const MembraneStiffness& k,
                             const PaddedState& x, PaddedState& gradient);

/// Adds d2E/dx2 [N/m] to the values of a Hessian, its negative geometric parts scaled by 1 - blend:
/// per direction k A c_i c_j [(1 - 1/l) I + (1/l) w w^T / l^2], where 1 - 1/l < 0 under
/// compression. blend = 0 is the true Hessian; blend = 1 is positive semidefinite, without an
/// eigenvalue decomposition.
void add_membrane_hessian(const std::vector<TriangleBatch>& batches,
                          const std::vector<TrianglePlaces>& places, const MembraneStiffness& k,
                          const PaddedState& x, double blend, double* values);

}  // namespace drape
