#include "benchmarks/baselines/methods.h"

#include <utility>

namespace drape::baselines {

const std::vector<Method>& methods() {
  static const std::vector<Method> list{
      {"core", "this solver", false,
       "May stop where the energy jumps (secant law); slow where the Hessian stays indefinite for "
       "long.",
       core_solver},
      {"projected_newton", "Newton, projected Hessian", false,
       "Never diverges; linear convergence, the slower the more the elements at rest are "
       "compressed, because the projection stays on.",
       projected_newton},
      {"levenberg_marquardt", "Levenberg-Marquardt", false,
       "Quadratic at the end; far from it most factorisations of the indefinite Hessian are spent "
       "on finding a damping.",
       levenberg_marquardt},
      {"lbfgs", "L-BFGS", false,
       "Iterations grow with the root of the stiffness ratio and with the mesh.",
       limited_memory_bfgs},
      {"conjugate_gradients", "conjugate gradients", false,
       "As L-BFGS, with more iterations; loses conjugacy where the energy is far from quadratic.",
       conjugate_gradients},
      {"implicit_euler", "implicit Euler, one solve", true,
       "Short steps crawl; long ones are projected Newton steps without a line search, with its "
       "linear convergence.",
       implicit_euler},
      {"backward_euler", "implicit Euler, Newton", true,
       "Never diverges; short steps crawl, long ones are the projected Newton method.",
       backward_euler},
      {"explicit_dynamics", "explicit dynamics", true,
       "Diverges beyond 2/omega; that limit shrinks with stiffness over mass and with the mesh, "
       "while the time to rest does not.",
       explicit_dynamics},
      {"dynamic_relaxation", "dynamic relaxation", false,
       "Always stable; iterations grow with the root of the stiffness ratio and with the mesh.",
       dynamic_relaxation},
      {"admm", "ADMM", false,
       "One constant factor for a stiffness that turns with the cloth: closes in more and more "
       "slowly or circles, the more so the stiffer the membrane.",
       admm},
      {"xpbd", "XPBD", true,
       "One sweep a step leaves forces of the size of the step: it rests without equilibrium; only "
       "steps as short as an explicit method's come close.",
       xpbd}};
  return list;
}

MethodRun run(const Method& method, const Potential& potential, VecX x, const Budget& budget) {
  Course course(potential, budget, x);
  x = method.minimise(potential, std::move(x), course);
  return course.finish(x);
}

}  // namespace drape::baselines
