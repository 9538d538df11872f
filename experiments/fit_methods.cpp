#include "experiments/fit_methods.h"

#include <nlopt.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "core/cpu_clock.h"
#include "estimation/minimise.h"
#include "experiments/config_names.h"

namespace drape {
namespace {

// Steps in log parameters: well above what the tolerance of a solve leaves open in a radius, well
// below where the outline bends.
constexpr double kForwardStep = 1e-4;
constexpr double kCentralStep = 1e-3;
constexpr double kFirstStep = 0.2;       // of the methods without derivatives
constexpr double kLost = 10;             // cost of a lost branch over the cost of the start
constexpr double kParameterStep = 1e-6;  // steps below it end a fit without derivatives

/// Passes an objective on and notes every improvement, until the CPU time is spent.
class Tracing final : public FitObjective {
 public:
  Tracing(FitObjective& objective, const DrapeObjective& drapes,
          const DifferencedObjective& differences, double cpu_seconds)
      : objective_(objective),
        drapes_(drapes),
        differences_(differences),
        budget_(cpu_seconds),
        begin_(thread_cpu_seconds()) {}

  int unknowns() const override { return objective_.unknowns(); }
  int residuals() const override { return objective_.residuals(); }
  bool residuals_at(const VecX& u, VecX& r, MatX* jacobian) override {
    if (spent() || !objective_.residuals_at(u, r, jacobian)) return false;
    note(u, 0.5 * r.squaredNorm());
    return true;
  }
  bool cost_at(const VecX& u, double& cost, VecX* gradient) override {
    if (spent() || !objective_.cost_at(u, cost, gradient)) return false;
    note(u, cost);
    return true;
  }
  bool refused() const override { return spent() || objective_.refused(); }
  bool at_edge() const override { return objective_.at_edge(); }

  bool spent() const { return thread_cpu_seconds() - begin_ > budget_; }
  std::vector<FitMoment> moments() && { return std::move(moments_); }

 private:
  void note(const VecX& u, double cost) {
    if (!moments_.empty() && !(cost < moments_.back().cost)) return;
    moments_.push_back(
        {thread_cpu_seconds() - begin_, drapes_.solves() + differences_.solves(), cost, u});
  }

  FitObjective& objective_;
  const DrapeObjective& drapes_;
  const DifferencedObjective& differences_;
  double budget_, begin_;
  std::vector<FitMoment> moments_;
};

/// What NLopt calls back with.
struct Search {
  Tracing& objective;
  nlopt_opt nlopt;
  double lost = std::numeric_limits<double>::quiet_NaN();
};

double search_cost(unsigned n, const double* z, double*, void* data) {
  Search& search = *static_cast<Search*>(data);
  if (search.objective.spent()) nlopt_force_stop(search.nlopt);
  double cost;
  const VecX u = Eigen::Map<const VecX>(z, static_cast<Eigen::Index>(n));
  if (!search.objective.cost_at(u, cost, nullptr)) return search.lost;
  if (std::isnan(search.lost)) search.lost = kLost * cost;
  return cost;
}

void search_without_derivatives(ComparedFit method, Tracing& objective, VecX z,
                                const MinimiseOptions& options, TracedFit& fit) {
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> nlopt(
      nlopt_create(method == ComparedFit::bobyqa ? NLOPT_LN_BOBYQA : NLOPT_LN_NELDERMEAD,
                   static_cast<unsigned>(z.size())),
      nlopt_destroy);
  Search search{objective, nlopt.get()};
  nlopt_set_min_objective(nlopt.get(), search_cost, &search);
  nlopt_set_lower_bounds(nlopt.get(), options.lower.data());
  nlopt_set_upper_bounds(nlopt.get(), options.upper.data());
  nlopt_set_initial_step1(nlopt.get(), kFirstStep);
  nlopt_set_stopval(nlopt.get(), options.sufficient_cost);
  nlopt_set_xtol_abs1(nlopt.get(), kParameterStep);
  double cost;
  const nlopt_result result = nlopt_optimize(nlopt.get(), z.data(), &cost);
  fit.converged = result > 0 && result != NLOPT_MAXEVAL_REACHED;
  fit.message = nlopt_result_to_string(result);
}

std::string label_of(ComparedFit method) {
  switch (method) {
    case ComparedFit::levenberg_marquardt:
      return "Levenberg-Marquardt, sensitivities";
    case ComparedFit::bfgs:
      return "BFGS, adjoint";
    case ComparedFit::levenberg_marquardt_differences:
      return "Levenberg-Marquardt, differences";
    case ComparedFit::bfgs_differences:
      return "BFGS, differences";
    case ComparedFit::bobyqa:
      return "BOBYQA, no derivatives";
    case ComparedFit::nelder_mead:
      return "Nelder-Mead, no derivatives";
  }
  throw std::logic_error("a method without a label");
}

}  // namespace

std::vector<FitMethodInfo> compared_fits(const std::vector<ComparedFit>& chosen) {
  const std::vector<std::string> names = names_of<ComparedFit>();
  std::vector<FitMethodInfo> list;
  const auto add = [&](ComparedFit m) {
    list.push_back({m, names[static_cast<size_t>(m)], label_of(m)});
  };
  for (const ComparedFit m : chosen) add(m);
  for (size_t i = 0; chosen.empty() && i < names.size(); ++i) add(static_cast<ComparedFit>(i));
  return list;
}

DifferencedObjective::DifferencedObjective(DrapeObjective& exact, double tolerance)
    : exact_(exact),
      misfit_(exact.picture(0), {}),
      potential_(exact.picture(0).model),
      tolerance_(tolerance) {
  if (exact.pictures() != 1 || exact.unknowns() != exact.space().size())
    throw std::invalid_argument("differences need one picture that has no nuisances");
}

/// The residuals where the k-th unknown is larger by a step.
bool DifferencedObjective::near_by(const VecX& u, int k, double step, VecX& r) {
  const BranchPoint* middle = exact_.drape_at(0, u);
  if (middle == nullptr) return false;
  BranchPoint point{u, {}, {}};
  point.z[k] += step;
  potential_.set_fabric(exact_.space().decode(point.z));
  point.equilibrium = solve_equilibrium(potential_, middle->equilibrium.x,
                                        {.tolerance = tolerance_, .certify = false},
                                        middle->equilibrium.preconditioner);
  ++solves_;
  if (!point.equilibrium.converged()) return false;
  misfit_.residuals(point, VecX(), r, nullptr);
  return true;
}

bool DifferencedObjective::residuals_at(const VecX& u, VecX& r, MatX* jacobian) {
  if (!exact_.residuals_at(u, r, nullptr)) return false;
  if (jacobian == nullptr) return true;
  jacobian->resize(residuals(), unknowns());
  for (int k = 0; k < unknowns(); ++k) {
    VecX ahead;
    if (!near_by(u, k, kForwardStep, ahead)) return false;
    jacobian->col(k) = (ahead - r) / kForwardStep;
  }
  return true;
}

bool DifferencedObjective::cost_at(const VecX& u, double& cost, VecX* gradient) {
  if (!exact_.cost_at(u, cost, nullptr)) return false;
  if (gradient == nullptr) return true;
  gradient->resize(unknowns());
  for (int k = 0; k < unknowns(); ++k) {
    VecX ahead, behind;
    if (!near_by(u, k, kCentralStep, ahead) || !near_by(u, k, -kCentralStep, behind)) return false;
    (*gradient)[k] = 0.5 * (ahead.squaredNorm() - behind.squaredNorm()) / (2 * kCentralStep);
  }
  return true;
}

TracedFit traced_fit(ComparedFit method, const Picture& picture, const ParameterSpace& space,
                     const TracedFitOptions& options) {
  if (!picture.start_state || picture.seen.nuisances() > 0)
    throw std::invalid_argument("a traced fit needs a picture with a start state, no nuisances");
  for (const Parameter p : space.parameters)
    if (!is_logarithmic(p))
      throw std::invalid_argument("a traced fit of " + std::string(name(p)) +
                                  ": only parameters that enter by their logarithm");
  TracedFit fit;
  DrapeObjective drapes({picture}, space, std::nullopt, {}, std::numeric_limits<int>::max());
  const VecX z = space.encode(space.reference);
  Potential potential = picture.model;
  potential.set_fabric(space.reference);
  drapes.start_from(0, potential, make_branch_point(potential, space, z, *picture.start_state),
                    options.continuation);
  DifferencedObjective differences(drapes, options.tolerance);
  const bool differenced = method == ComparedFit::levenberg_marquardt_differences ||
                           method == ComparedFit::bfgs_differences;
  Tracing tracing(differenced ? static_cast<FitObjective&>(differences) : drapes, drapes,
                  differences, options.cpu_seconds);

  const double reach = std::log(options.bound_factor);
  MinimiseOptions minimise_options{.max_iterations = 1000,
                                   .function_tolerance = 1e-12,
                                   .parameter_tolerance = 1e-9,
                                   .sufficient_cost = options.sufficient_cost,
                                   .lower = z.array() - reach,
                                   .upper = z.array() + reach};
  if (method == ComparedFit::bobyqa || method == ComparedFit::nelder_mead) {
    search_without_derivatives(method, tracing, z, minimise_options, fit);
  } else {
    if (method == ComparedFit::bfgs || method == ComparedFit::bfgs_differences)
      minimise_options.method = FitMethod::bfgs;
    const Minimum minimum = minimise(tracing, z, minimise_options);
    fit.converged = minimum.converged;
    fit.message = minimum.message;
  }
  fit.moments = std::move(tracing).moments();
  return fit;
}

}  // namespace drape
