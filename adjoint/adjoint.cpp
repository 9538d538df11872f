#include "adjoint/adjoint.h"

#include <stdexcept>
#include <string>

namespace drape {

void require_minimum(const Potential& potential, const Equilibrium& equilibrium) {
  if (!equilibrium.converged() || !equilibrium.factor)
    throw std::invalid_argument("adjoint: the state is no converged, certified minimum (status " +
                                std::string(name(equilibrium.status)) +
                                "); derivatives exist only at an equilibrium");
  if (equilibrium.x.size() != 3 * potential.mesh().vertex_count())
    throw std::invalid_argument("adjoint: the equilibrium belongs to another mesh");
}

ParameterVector adjoint_gradient(const Potential& potential, const Equilibrium& equilibrium,
                                 const VecX& dL_dx) {
  require_minimum(potential, equilibrium);
  const Discretization& d = potential.discretization();
  const VecX lambda = d.to_full(equilibrium.factor->solve(-d.to_free(dL_dx)));
  return potential.gradient_dfabric_transposed(equilibrium.x, lambda);
}

}  // namespace drape
