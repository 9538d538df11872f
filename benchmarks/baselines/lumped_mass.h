// What the methods that simulate motion share: masses lumped at the vertices.
#pragma once

#include "core/potential.h"

namespace drape::baselines {

/// Masses in the layout of a state (3n) [kg]; 1 at fixed vertices, which no force moves.
inline VecX lumped_masses(const Potential& potential) {
  VecX mass = VecX::Ones(3 * potential.mesh().vertex_count());
  for (int v : potential.discretization().free_vertices())
    mass.segment<3>(3 * v).setConstant(potential.fabric().areal_density *
                                       potential.mesh().nodal_area[v]);
  return mass;
}

/// Largest distance that a vertex moves in a step d (3 values a vertex) [m].
inline double largest_move(const VecX& d) {
  return d.reshaped(3, d.size() / 3).colwise().norm().maxCoeff();
}

}  // namespace drape::baselines
