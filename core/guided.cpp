#include "core/guided.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/coarse_choice.h"
#include "core/drape_protocol.h"

namespace drape {
namespace {

constexpr double kLooseTolerance = 0.1;  // residual under a guide that is to be released

}  // namespace

Equilibrium solve_under_guide(const Potential& potential, const Scene& scene, const Guide& guide,
                              const EquilibriumOptions& options) {
  Potential guided = potential;
  guided.set_guide(guide);
  Equilibrium result =
      solve_stiffening(guided, scene, state_from_outline(potential.mesh(), scene, guide), options);
  result.protocol = "guided";
  return result;
}

Equilibrium solve_under_guide_from_coarse(const Potential& potential, const Scene& scene,
                                          const Guide& guide, const EquilibriumOptions& options) {
  Potential guided = potential;
  guided.set_guide(guide);
  Equilibrium result = chosen_on_coarse_mesh(
      guided, options, [&](const Potential& coarse, const EquilibriumOptions& loose) {
        return solve_under_guide(coarse, scene, guide, loose);
      });
  result.protocol = "guided";
  return result;
}

Equilibrium drape_guided(const Potential& potential, const Scene& scene, Guide guide,
                         const std::vector<double>& kappas, const EquilibriumOptions& options) {
  if (kappas.empty())
    throw std::invalid_argument("guided drape: no strength of the guide is given");
  const EquilibriumOptions held = options.loosened(kLooseTolerance);
  guide.kappa = kappas.front();
  Equilibrium result = solve_under_guide(potential, scene, guide, held);
  for (size_t i = 1; i <= kappas.size() && result.converged(); ++i) {
    Potential released = potential;
    released.set_guide(std::nullopt);
    if (i < kappas.size()) {
      guide.kappa = kappas[i];
      released.set_guide(guide);
    }
    Equilibrium next = solve_equilibrium(released, result.x, i < kappas.size() ? held : options);
    next.add_work_of(result);
    next.protocol = std::move(result.protocol);
    result = std::move(next);
  }
  return result;
}

}  // namespace drape
