#include "estimation/minimise.h"

#include <ceres/ceres.h>

#include <limits>
#include <utility>

namespace drape {
namespace {

constexpr double kScalingDamping = 1e-3;  // of the largest diagonal entry of J^T J
constexpr double kWorthwhile = 0.9;  // of the cost: less is left by a run that is worth another

class ProfileResiduals : public ceres::CostFunction {
 public:
  explicit ProfileResiduals(FitObjective& objective) : objective_(objective) {
    set_num_residuals(objective.residuals());
    mutable_parameter_block_sizes()->push_back(objective.unknowns());
  }
  bool Evaluate(double const* const* u, double* residuals, double** jacobians) const override {
    VecX r;
    MatX jacobian;
    const bool wanted = jacobians != nullptr && jacobians[0] != nullptr;
    if (!objective_.residuals_at(Eigen::Map<const VecX>(u[0], objective_.unknowns()), r,
                                 wanted ? &jacobian : nullptr))
      return false;
    Eigen::Map<VecX>(residuals, r.size()) = r;
    if (wanted)
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          jacobians[0], jacobian.rows(), jacobian.cols()) = jacobian;
    return true;
  }

 private:
  FitObjective& objective_;
};

/// The cost in scaled unknowns v, u = origin + scaling v. Remembers the best state: where a line
/// search fails Ceres gives back the first one.
class AdjointCost : public ceres::FirstOrderFunction {
 public:
  AdjointCost(FitObjective& objective, VecX origin, MatX scaling, const MinimiseOptions& options)
      : objective_(objective),
        origin_(std::move(origin)),
        scaling_(std::move(scaling)),
        options_(options),
        best_(origin_) {}
  int NumParameters() const override { return objective_.unknowns(); }
  const VecX& best() const { return best_; }
  double best_cost() const { return best_cost_; }
  bool Evaluate(const double* v, double* cost, double* gradient) const override {
    const VecX u = origin_ + scaling_ * Eigen::Map<const VecX>(v, objective_.unknowns());
    if ((u.array() < options_.lower.array()).any() || (u.array() > options_.upper.array()).any())
      return false;
    VecX g;
    if (!objective_.cost_at(u, *cost, gradient != nullptr ? &g : nullptr)) return false;
    if (gradient != nullptr) Eigen::Map<VecX>(gradient, g.size()) = scaling_.transpose() * g;
    if (*cost < best_cost_) {
      best_cost_ = *cost;
      best_ = u;
    }
    return true;
  }

 private:
  FitObjective& objective_;
  VecX origin_;
  MatX scaling_;
  const MinimiseOptions& options_;
  mutable VecX best_;
  mutable double best_cost_ = std::numeric_limits<double>::infinity();
};

/// L^-T of the damped Gauss-Newton matrix J^T J = L L^T at the start, where the sensitivities are
/// known anyway: in these units BFGS begins with a Gauss-Newton step instead of one along the
/// gradient.
MatX gauss_newton_scaling(FitObjective& objective, const VecX& u) {
  VecX r;
  MatX J;
  const Eigen::Index n = u.size();
  if (!objective.residuals_at(u, r, &J)) return MatX::Identity(n, n);
  MatX normal = J.transpose() * J;
  normal.diagonal().array() += kScalingDamping * normal.diagonal().maxCoeff();
  return normal.llt().matrixU().solve(MatX::Identity(n, n));
}

/// Where the cost is far inside the noise, and where the objective has no value next to the state
/// at hand: Ceres would halve its steps towards the edge again and again.
class StopEarly : public ceres::IterationCallback {
 public:
  StopEarly(const FitObjective& objective, double sufficient)
      : objective_(objective), sufficient_(sufficient) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    return summary.cost <= sufficient_ || objective_.at_edge()
               ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
               : ceres::SOLVER_CONTINUE;
  }

 private:
  const FitObjective& objective_;
  double sufficient_;
};

/// What both of Ceres' solvers report.
template <typename Summary>
void keep(const Summary& summary, double cost, const FitObjective& objective,
          const MinimiseOptions& options, Minimum& minimum) {
  minimum.initial_cost = summary.initial_cost;
  minimum.cost = cost;
  minimum.iterations = static_cast<int>(summary.iterations.size());
  const bool sufficient = minimum.cost <= options.sufficient_cost;
  const bool at_edge = objective.at_edge() && !sufficient;
  minimum.converged = sufficient || (summary.termination_type == ceres::CONVERGENCE && !at_edge &&
                                     !objective.refused());
  minimum.message = at_edge ? "a branch of drapes ends at the last state" : summary.message;
}

Minimum levenberg_marquardt(FitObjective& objective, const VecX& u,
                            const MinimiseOptions& options) {
  Minimum minimum;
  minimum.u = u;
  ceres::Problem problem;
  problem.AddResidualBlock(new ProfileResiduals(objective), nullptr, minimum.u.data());
  for (int i = 0; i < objective.unknowns(); ++i) {
    problem.SetParameterLowerBound(minimum.u.data(), i, options.lower[i]);
    problem.SetParameterUpperBound(minimum.u.data(), i, options.upper[i]);
  }
  ceres::Solver::Options ceres_options;
  ceres_options.linear_solver_type = ceres::DENSE_QR;
  ceres_options.max_num_iterations = options.max_iterations;
  ceres_options.function_tolerance = options.function_tolerance;
  ceres_options.parameter_tolerance = options.parameter_tolerance;
  ceres_options.gradient_tolerance = 1e-12;
  ceres_options.initial_trust_region_radius = 1e2;
  ceres_options.max_num_consecutive_invalid_steps = 8;
  StopEarly stop(objective, options.sufficient_cost);
  ceres_options.callbacks.push_back(&stop);
  ceres_options.logging_type = ceres::SILENT;
  ceres_options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(ceres_options, &problem, &summary);
  keep(summary, summary.final_cost, objective, options, minimum);
  return minimum;
}

/// One run of Ceres from u.
Minimum bfgs_from(FitObjective& objective, const VecX& u, const MinimiseOptions& options) {
  auto* const cost =  // owned by the problem
      new AdjointCost(objective, u, gauss_newton_scaling(objective, u), options);
  const ceres::GradientProblem problem(cost);
  VecX v = VecX::Zero(u.size());
  ceres::GradientProblemSolver::Options ceres_options;
  ceres_options.line_search_direction_type = ceres::BFGS;
  ceres_options.max_num_iterations = options.max_iterations;
  ceres_options.function_tolerance = options.function_tolerance;
  ceres_options.parameter_tolerance = options.parameter_tolerance;
  ceres_options.gradient_tolerance = 1e-12;
  StopEarly stop(objective, options.sufficient_cost);
  ceres_options.callbacks.push_back(&stop);
  ceres_options.logging_type = ceres::SILENT;
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(ceres_options, problem, v.data(), &summary);
  Minimum minimum;
  minimum.u = cost->best();
  keep(summary, cost->best_cost(), objective, options, minimum);
  return minimum;
}

/// A line search fails where what BFGS has learned on the way is no model of where it is, or where
/// the drapes that it asks for are on no branch; it then begins anew at the best state, in the
/// units of that state, as long as this helps.
Minimum bfgs(FitObjective& objective, const VecX& u, const MinimiseOptions& options) {
  Minimum minimum = bfgs_from(objective, u, options);
  for (bool worthwhile = true; worthwhile && !minimum.converged && !objective.at_edge() &&
                               minimum.iterations < options.max_iterations;) {
    MinimiseOptions rest = options;
    rest.max_iterations -= minimum.iterations;
    Minimum next = bfgs_from(objective, minimum.u, rest);
    if (!(next.cost <= minimum.cost)) break;
    worthwhile = next.cost < kWorthwhile * minimum.cost;
    next.initial_cost = minimum.initial_cost;
    next.iterations += minimum.iterations;
    minimum = std::move(next);
  }
  return minimum;
}

}  // namespace

Minimum minimise(FitObjective& objective, const VecX& u, const MinimiseOptions& options) {
  return options.method == FitMethod::bfgs ? bfgs(objective, u, options)
                                           : levenberg_marquardt(objective, u, options);
}

}  // namespace drape
