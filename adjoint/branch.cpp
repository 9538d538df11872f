#include "adjoint/branch.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "adjoint/adjoint.h"

namespace drape {
namespace {

constexpr int kPatience = 8;  // iterations in a row further from the prediction than may count

/// One predicted and corrected step; nothing if it left the branch. The way from a snap to the next
/// minimum is long, and its end counts for nothing: the solve stops once it stays away.
std::optional<BranchState> step_to(Potential& potential, const FabricPath& path,
                                   const BranchState& from, double s, const BranchOptions& options,
                                   ContinuationCost& cost) {
  potential.set_fabric(path.fabric(s));
  const VecX predicted = from.equilibrium.x + (s - from.s) * from.dx_ds;
  const double allowed = allowed_deviation(options, predicted, from.equilibrium.x);
  int away = 0;
  EquilibriumOptions correction = options.equilibrium;
  correction.go_on = [&](const VecX& x, const VecX& gradient) {
    away = largest_distance(x, predicted) > allowed ? away + 1 : 0;
    const auto& go_on = options.equilibrium.go_on;
    return away < kPatience && (!go_on || go_on(x, gradient));
  };
  Equilibrium equilibrium =
      solve_equilibrium(potential, predicted, correction, from.equilibrium.factor);
  ++cost.solves;
  cost.newton_iterations += equilibrium.newton_iterations;
  cost.factorizations += equilibrium.factorizations;
  if (!equilibrium.converged() || largest_distance(equilibrium.x, predicted) > allowed)
    return std::nullopt;
  equilibrium.protocol = from.equilibrium.protocol;
  return make_branch_state(potential, path, s, std::move(equilibrium));
}

}  // namespace

double allowed_deviation(const BranchOptions& options, const VecX& predicted, const VecX& from) {
  return std::max(options.noise, options.largest_deviation * largest_distance(predicted, from));
}

FabricPath scaled_path(const Fabric& fabric, const std::vector<Parameter>& parameters) {
  const auto scaled = [fabric, parameters](double s) {
    Fabric at = fabric;
    for (Parameter p : parameters) at[p] *= std::exp(s);
    return at;
  };
  const auto rate = [scaled, parameters](double s) {
    const Fabric at = scaled(s);
    ParameterVector dp = ParameterVector::Zero();
    for (Parameter p : parameters) dp[static_cast<int>(p)] = at[p];
    return dp;
  };
  return {scaled, rate};
}

VecX gradient_ds(const Potential& potential, const FabricPath& path, double s, const VecX& x) {
  return potential.gradient_dfabric(x) * path.dp_ds(s);
}

BranchState make_branch_state(const Potential& potential, const FabricPath& path, double s,
                              Equilibrium equilibrium) {
  require_minimum(potential, equilibrium);
  const Discretization& d = potential.discretization();
  const VecX dg = d.to_free(gradient_ds(potential, path, s, equilibrium.x));
  VecX dx_ds = d.to_full(equilibrium.factor->solve(-dg));
  return {s, std::move(equilibrium), std::move(dx_ds)};
}

bool follow_minima(Potential& potential, const FabricPath& path, double s1,
                   const BranchOptions& options, BranchState& state, ContinuationCost& cost,
                   const std::function<bool(const BranchState&)>& visit) {
  const double direction = s1 >= state.s ? 1 : -1;
  double step = options.largest_step;
  while (state.s != s1) {
    const bool last = step > (1 - 1e-12) * std::abs(s1 - state.s);
    const double next = last ? s1 : state.s + direction * step;
    auto reached = step_to(potential, path, state, next, options, cost);
    if (reached) {
      state = *std::move(reached);
      if (visit && !visit(state)) return false;
      step = std::min(2 * step, options.largest_step);
    } else {
      step = std::abs(next - state.s) / 2;
      if (step < options.smallest_step) return false;
    }
  }
  return true;
}

}  // namespace drape
