#include "benchmarks/baselines/methods.h"

#include <utility>

namespace drape::baselines {

const std::vector<Method>& methods() {
  static const std::vector<Method> list{
      {"core", "this solver", false, core_solver},
      {"projected_newton", "Newton, projected Hessian", false, projected_newton},
      {"levenberg_marquardt", "Levenberg-Marquardt", false, levenberg_marquardt},
      {"lbfgs", "L-BFGS", false, limited_memory_bfgs},
      {"conjugate_gradients", "conjugate gradients", false, conjugate_gradients},
      {"implicit_euler", "implicit Euler, one solve", true, implicit_euler},
      {"backward_euler", "implicit Euler, Newton", true, backward_euler},
      {"explicit_dynamics", "explicit dynamics", true, explicit_dynamics},
      {"dynamic_relaxation", "dynamic relaxation", false, dynamic_relaxation},
      {"admm", "ADMM", false, admm},
      {"xpbd", "XPBD", true, xpbd}};
  return list;
}

MethodRun run(const Method& method, const Potential& potential, VecX x, const Budget& budget) {
  Course course(potential, budget, x);
  x = method.minimise(potential, std::move(x), course);
  return course.finish(x);
}

}  // namespace drape::baselines
