#include "benchmarks/baselines/methods.h"

#include <utility>

namespace drape::baselines {

const std::vector<Method>& methods() {
  static const std::vector<Method> list{
      {"core", "this solver", false, core_solver,
       "Every step leads down, but for a few over jumps of the energy, and the end is certified by "
       "a Cholesky factor of the full Hessian. It can run out of time or reach the rounding floor "
       "of the residual, and says which (core/equilibrium.h)."},
      {"projected_newton", "Newton, projected Hessian", false, projected_newton,
       "A drape at rest keeps compressed elements, so the projection never switches off: near "
       "the end a step shrinks the residual by 1 - λ_min(H(1)⁻¹ H), linearly where Newton's "
       "method is quadratic (Longva et al. 2023), and hardly at all near a snap, where H is "
       "almost singular. Its line search cannot pass a jump of the energy, as the secant law "
       "has."},
      {"levenberg_marquardt", "Levenberg-Marquardt", false, levenberg_marquardt,
       "With the full Hessian it is quadratic at the end (Moré 1978). These elements have no "
       "barrier against collapse: a step flattens a needle, about whose edge forces have no bound, "
       "and the method does not come back from there."},
      {"lbfgs", "L-BFGS", false, limited_memory_bfgs,
       "Without a preconditioner the iterations grow with the root of the Hessian's condition "
       "number (Nocedal and Wright 2006, sections 5.1 and 7.2), which a stiff membrane and a fine "
       "mesh make large. Its line search cannot pass a jump of the energy, and flattens needles, "
       "which have no barrier against it."},
      {"conjugate_gradients", "conjugate gradients", false, conjugate_gradients,
       "As for L-BFGS the iterations grow with the root of the Hessian's condition number (Nocedal "
       "and Wright 2006, section 5.1); each costs more, for the directions lose their conjugacy "
       "unless the line search is tight. A jump of the energy stops it, and it flattens needles."},
      {"implicit_euler", "implicit Euler, one solve", true, implicit_euler,
       "A long step (Baraff and Witkin 1998) is one of Newton's method with the projected "
       "Hessian and converges as slowly. In short ones the budget ends before the cloth has come "
       "to rest: a step costs a factorisation, whatever its length."},
      {"backward_euler", "implicit Euler, Newton", true, backward_euler,
       "A long step is Newton's method with the projected Hessian and a little inertia (Gast et "
       "al. 2015): linear at the same rate. In short ones the budget ends before the cloth has "
       "come to rest, sooner than with one solve a step. Its line search cannot pass a jump of "
       "the energy."},
      {"explicit_dynamics", "explicit dynamics", true, explicit_dynamics,
       "It diverges for h > 2/ω, ω the highest frequency of M⁻¹ H (Belytschko et al. 2000), "
       "which grows with the root of the membrane's stiffness over the density and with one over "
       "the edge length. The swinging of the overhang does not become faster, so that ever more "
       "steps bring it to rest."},
      {"dynamic_relaxation", "dynamic relaxation", false, dynamic_relaxation,
       "Explicit steps too, with the masses that make them just stable (Barnes 1999): their number "
       "grows with the root of the condition number. The masses hold for the state that they were "
       "taken in; needles turn faster than they are renewed, and the motion diverges."},
      {"admm", "ADMM", false, admm,
       "The energies are not convex, and nothing ensures convergence (Overby et al. 2017). Where "
       "compression exceeds a direction's weight over its stiffness, the multiplier turns the "
       "direction over and the iterates cycle, as on the way from a folded start; heavier weights "
       "end that but are slower. Stiff membranes are slow with any weight."},
      {"xpbd", "XPBD", true, xpbd,
       "One sweep a step leaves part of every constraint to the next step (Macklin et al. 2019): "
       "the cloth comes to rest without equilibrium of forces. What is left falls with h and grows "
       "with the stiffness over the mass; but the shorter h, the more steps to come to rest."}};
  return list;
}

MethodRun run(const Method& method, const Potential& potential, VecX x, const Budget& budget) {
  Course course(potential, budget, x);
  x = method.minimise(potential, std::move(x), course);
  return course.finish(x);
}

}  // namespace drape::baselines
