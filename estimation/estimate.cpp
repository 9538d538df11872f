#include "estimation/estimate.h"

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/cpu_clock.h"
#include "core/guided.h"

namespace drape {
namespace {

constexpr double kLargestCentre = 10;     // the unknowns of the centre are bounded to +-10 mm
constexpr double kStageTolerance = 1e-3;  // relative cost change that ends a guided fit
constexpr double kFinalTolerance =
    1e-6;  // and the last one, far below what noise leaves of the cost

/// One estimation from start to end; each method is one stage.
class Estimation {
 public:
  Estimation(const Potential& model, const Scene& scene, const OutlineObservation& observation,
             const Fabric& start, const EstimateOptions& options)
      : potential_(model),
        scene_(scene),
        observation_(observation),
        options_(options),
        objective_(model, scene, {options.parameters, start}, observation, options.loss,
                   options.prior_log_sd, options.max_solves) {
    result_.start = result_.fabric = start;
    u_ = VecX::Zero(objective_.unknowns());
    u_.head(objective_.space().size()) = objective_.space().encode(start);
    potential_.set_fabric(start);
  }

  Estimate run(const std::optional<Equilibrium>& start_state) {
    const double start_time = thread_cpu_seconds();
    fit(start_state);
    result_.forward_solves += objective_.work().solves;
    result_.cpu_seconds = thread_cpu_seconds() - start_time;
    return std::move(result_);
  }

 private:
  void fit(const std::optional<Equilibrium>& start_state) {
    potential_.set_guide(std::nullopt);
    if (start_state) {
      result_.equilibrium = *start_state;
      result_.contact.support = potential_.support().has_value();
      result_.contact.reason = "As in the state that the fit starts from.";
    } else if (!guided_start()) {
      result_.outcome = EstimateOutcome::no_start;
      return;
    }
    result_.start_profile = profile_of(result_.equilibrium);
    if (!start_state)
      for (double kappa : options_.guide) {
        if (!set_guide(kappa)) return;
        fit_stage(kStageTolerance);
      }
    if (!set_guide(0)) return;
    const Minimum minimum = fit_stage(kFinalTolerance);
    result_.outcome =
        minimum.converged ? EstimateOutcome::succeeded : EstimateOutcome::not_converged;
    finish();
  }

  Guide guide_of(double kappa) const {
    return {harmonics(observation_.profile, options_.guide_harmonics), objective_.centre_of(u_),
            kappa};
  }

  bool guided_start() {
    const double kappa = options_.guide.empty() ? 1 : options_.guide.front();
    result_.kappa = kappa;
    const Guide guide = guide_of(kappa);
    potential_.set_guide(guide);
    ContactDrape start = drape_with_contact(
        potential_, scene_, options_.contact,
        [&](const Potential& potential) {
          return solve_under_guide(potential, scene_, guide, options_.equilibrium);
        },
        options_.equilibrium);
    result_.equilibrium = std::move(start.equilibrium);
    result_.contact = std::move(start.contact);
    const bool solved_again = result_.contact.support && options_.contact == ContactMode::automatic;
    result_.forward_solves += solved_again ? 2 : 1;
    return result_.equilibrium.converged();
  }

  /// The drape at the current unknowns under another guide; false when there is none near-by.
  bool set_guide(double kappa) {
    potential_.set_fabric(result_.fabric);
    potential_.set_guide(kappa > 0 ? std::optional(guide_of(kappa)) : std::nullopt);
    Equilibrium equilibrium =
        solve_equilibrium(potential_, result_.equilibrium.x, options_.equilibrium);
    ++result_.forward_solves;
    if (!equilibrium.converged()) {
      result_.outcome = EstimateOutcome::branch_lost;
      result_.message = "no equilibrium at kappa = " + std::to_string(kappa);
      finish();
      return false;
    }
    equilibrium.protocol = result_.equilibrium.protocol;
    result_.kappa = kappa;
    const ParameterSpace& space = objective_.space();
    objective_.start_from(
        potential_,
        make_branch_point(potential_, space, u_.head(space.size()), std::move(equilibrium)),
        kappa > 0 ? guided_continuation() : options_.continuation);
    return true;
  }

  /// A guide holds the outline while the cloth below snaps from one state to the next: such steps
  /// count, for the outline hardly changes and the branch is chosen only when the guide is gone.
  ContinuationOptions guided_continuation() const {
    ContinuationOptions guided = options_.continuation;
    guided.largest_deviation = std::numeric_limits<double>::infinity();
    return guided;
  }

  Minimum fit_stage(double tolerance) {
    MinimiseOptions options;
    options.method = options_.method;
    options.max_iterations = options_.max_iterations;
    options.function_tolerance = tolerance;
    const int p = objective_.space().size();
    const VecX z = objective_.space().encode(result_.start);
    options.lower = VecX::Constant(objective_.unknowns(), -kLargestCentre);
    options.upper = VecX::Constant(objective_.unknowns(), kLargestCentre);
    for (int i = 0; i < p; ++i) {
      const Parameter parameter = options_.parameters[static_cast<size_t>(i)];
      const double reach = std::log(options_.bound_factor);
      options.lower[i] = is_logarithmic(parameter) ? z[i] - reach : 0;
      options.upper[i] = is_logarithmic(parameter) ? z[i] + reach : 1;
    }
    const Minimum minimum = minimise(objective_, u_, options);
    if (const BranchPoint* drape = objective_.drape_at(minimum.u)) {
      u_ = minimum.u;
      result_.fabric = objective_.space().decode(drape->z);
      result_.equilibrium = drape->equilibrium;
    }
    result_.iterations += minimum.iterations;
    result_.message = minimum.message;
    return minimum;
  }

  VecX profile_of(const Equilibrium& equilibrium) const {
    const Outline outline = trace_outline(potential_.mesh(), scene_, equilibrium.x);
    return radial_profile(outline.points, objective_.centre_of(u_)).radius;
  }

  /// Looks at the last state. What acts on it was decided at the start.
  void check_last_contact() {
    const VecX& x = result_.equilibrium.x;
    std::string reason = std::move(result_.contact.reason);
    result_.contact = check_contact(potential_, scene_, x);
    result_.contact.reason = std::move(reason);
    result_.contact_doubtful = would_choose_otherwise(potential_, result_.contact, x);
  }

  void finish() {
    check_last_contact();
    result_.centre = objective_.centre_of(u_);
    result_.outline_rms = std::sqrt(
        (profile_of(result_.equilibrium) - observation_.profile).squaredNorm() / kProfileSize);
    VecX r;
    MatX jacobian;
    result_.log_sd = VecX::Constant(objective_.space().size(), std::nan(""));
    if (result_.outcome == EstimateOutcome::branch_lost ||
        !objective_.residuals_at(u_, r, &jacobian))
      return;
    const Eigen::CompleteOrthogonalDecomposition<MatX> qr(jacobian.transpose() * jacobian);
    if (qr.rank() == jacobian.cols())
      result_.log_sd =
          qr.pseudoInverse().diagonal().head(objective_.space().size()).cwiseMax(0).cwiseSqrt();
  }

  Potential potential_;
  Scene scene_;
  OutlineObservation observation_;
  EstimateOptions options_;
  DrapeObjective objective_;
  VecX u_;
  Estimate result_;
};

}  // namespace

std::string_view name(EstimateOutcome outcome) {
  switch (outcome) {
    case EstimateOutcome::succeeded:
      return "succeeded";
    case EstimateOutcome::no_start:
      return "no_start";
    case EstimateOutcome::branch_lost:
      return "branch_lost";
    case EstimateOutcome::not_converged:
      return "not_converged";
  }
  return "unknown";
}

Estimate estimate(const Potential& model, const Scene& scene, const OutlineObservation& observation,
                  const Fabric& start, const EstimateOptions& options,
                  const std::optional<Equilibrium>& start_state) {
  if (observation.profile.size() != kProfileSize || !observation.profile.allFinite())
    throw std::invalid_argument("estimate: the observed profile must hold " +
                                std::to_string(kProfileSize) + " finite radii");
  if (options.parameters.empty())
    throw std::invalid_argument("estimate: no parameters to estimate");
  if (start_state && !start_state->converged())
    throw std::invalid_argument("estimate: the start state is not a converged equilibrium");
  return Estimation(model, scene, observation, start, options).run(start_state);
}

}  // namespace drape
