// The methods that other cloth solvers minimise the same potential with, and core's own, behind one
// interface. Each is described at the head of its source file; all are serial and start from a
// state x (3n). They are here to be compared with, in studies and figures.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "benchmarks/baselines/course.h"

namespace drape::baselines {

VecX explicit_dynamics(const Potential& potential, VecX x, Course& course);
VecX dynamic_relaxation(const Potential& potential, VecX x, Course& course);
VecX implicit_euler(const Potential& potential, VecX x, Course& course);
VecX backward_euler(const Potential& potential, VecX x, Course& course);
VecX admm(const Potential& potential, VecX x, Course& course);
VecX xpbd(const Potential& potential, VecX x, Course& course);
VecX limited_memory_bfgs(const Potential& potential, VecX x, Course& course);
VecX conjugate_gradients(const Potential& potential, VecX x, Course& course);
VecX projected_newton(const Potential& potential, VecX x, Course& course);
VecX levenberg_marquardt(const Potential& potential, VecX x, Course& course);
VecX core_solver(const Potential& potential, VecX x, Course& course);

struct Method {
  std::string_view name;   ///< in configs and results
  std::string_view label;  ///< in figures
  bool has_time_step;
  VecX (*minimise)(const Potential&, VecX, Course&);  ///< returns the state it ends with
  std::string_view limits;  ///< why methods of this kind fail where they do, and who says so
};

/// core's solver first.
const std::vector<Method>& methods();

/// Runs a method from x (3n). Throws std::invalid_argument where a method cannot treat the
/// potential's terms (ADMM and XPBD: a guide, a plate or contact).
MethodRun run(const Method& method, const Potential& potential, VecX x, const Budget& budget);

}  // namespace drape::baselines
