#include "core/coarse_choice.h"

#include <algorithm>
#include <utility>

#include "core/coarse_level.h"

namespace drape {
namespace {

constexpr double kLooseTolerance = 0.1;  // residual on the coarse mesh

}  // namespace

Equilibrium restated(const Potential& potential, Equilibrium result) {
  if (result.converged()) return result;
  VecX gradient;
  result.energy = potential.energy_and_gradient(result.x, gradient);
  result.residual = potential.residual(gradient);
  result.rounding_floor = potential.rounding_floor(result.x);
  return result;
}

Equilibrium chosen_on_coarse_mesh(const Potential& potential, const EquilibriumOptions& options,
                                  const Choice& choose) {
  const CoarseLevel* level = potential.discretization().coarse();
  if (level == nullptr) return restated(potential, choose(potential, options));

  Potential coarse(level->discretization, potential.fabric(), potential.reading(),
                   potential.gravity());
  coarse.set_guide(potential.guide());
  coarse.set_support(potential.support());
  Equilibrium chosen = choose(coarse, options.loosened(kLooseTolerance));
  chosen.x = level->transfer(chosen.x);
  if (!chosen.converged()) {
    chosen.preconditioner = nullptr;  // of the coarse mesh
    return restated(potential, std::move(chosen));
  }
  EquilibriumOptions rest = options;
  rest.max_iterations -= chosen.newton_iterations;
  Equilibrium result = solve_equilibrium(potential, chosen.x, rest);
  result.add_work_of(chosen);
  return result;
}

}  // namespace drape
