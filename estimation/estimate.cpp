#include "estimation/estimate.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/cpu_clock.h"
#include "core/guided.h"
#include "estimation/branch_search.h"

namespace drape {
namespace {

constexpr double kLargestCentre = 10;     // the unknowns of the centre are bounded to +-10 mm
constexpr double kStageTolerance = 1e-3;  // relative cost change that ends a guided fit
constexpr int kStageIterations = 15;      // on a wrong branch a guided fit creeps on
constexpr double kFinalTolerance =
    1e-6;  // of the free fit, far below what noise leaves of the cost

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
  /// How far a fit has come: what is restored when a later one is no better.
  struct Progress {
    Estimate result;
    VecX u;
  };

  void fit(const std::optional<Equilibrium>& start_state) {
    potential_.set_guide(std::nullopt);
    if (start_state) {
      result_.equilibrium = *start_state;
      result_.contact.support = potential_.support().has_value();
      result_.contact.reason = "As in the state that the fit starts from.";
      result_.start_profile = profile_of(result_.equilibrium);
      if (release(0)) judge(std::nullopt);
    } else {
      search();
    }
    if (result_.outcome != EstimateOutcome::no_start) finish();
  }

  /// Fits from one guided start after the other, until one explains the outline (branch_search.h).
  /// Each takes up the unknowns that explained it best under the first guide.
  void search() {
    std::optional<Progress> best;
    VecX u = u_;
    double guided_miss = std::numeric_limits<double>::infinity();
    for (const GuidedStart& start : guided_starts(options_.guide, options_.guide_harmonics)) {
      if (u != u_) set_unknowns(u);
      start_ = start;
      if (!guided_start()) continue;
      result_.outcome = EstimateOutcome::branch_lost;  // until the guide is gone
      if (result_.start_profile.size() == 0)
        result_.start_profile = profile_of(result_.equilibrium);
      std::optional<Progress> guided;  // the last guided state with the nodes observed
      bool worth_releasing = true;
      for (size_t i = 0; worth_releasing && i < options_.guide.size(); ++i) {
        worth_releasing = release(options_.guide[i]);
        if (worth_releasing && i == 0) {
          worth_releasing = outline_miss() < guided_miss;
          if (worth_releasing) guided_miss = outline_miss(), u = u_;
        }
        if (worth_releasing && same_nodes()) guided = Progress{result_, u_};
      }
      if (worth_releasing && release(0)) judge(guided);
      result_.outline_rms = outline_miss();
      if (!best || is_better(result_, best->result)) best = Progress{result_, u_};
      if (result_.outcome == EstimateOutcome::succeeded) break;
    }
    if (best) restore(*best);
  }

  /// Fits under a guide (kappa > 0) or freely from the state at hand; false when there is none.
  bool release(double kappa) {
    if (!set_guide(kappa)) return false;
    const Minimum minimum = kappa > 0 ? fit_stage(kStageTolerance, kStageIterations)
                                      : fit_stage(kFinalTolerance, options_.max_iterations);
    if (kappa == 0)
      result_.outcome =
          minimum.converged ? EstimateOutcome::succeeded : EstimateOutcome::not_converged;
    return true;
  }

  /// What a free fit is worth. One with other nodes than observed has left the branch; `guided` is
  /// then shown instead, the last state that had them.
  void judge(const std::optional<Progress>& guided) {
    const double miss = outline_miss();
    if (guided && !same_nodes()) {
      const std::string message =
          "the free drape has " + std::to_string(node_count(profile_of(result_.equilibrium))) +
          " nodes, the observed outline " + std::to_string(node_count(observation_.profile));
      restore(*guided);
      result_.outcome = EstimateOutcome::branch_lost;
      result_.message = message;
    } else if (result_.outcome == EstimateOutcome::succeeded &&
               !explains(miss, observation_.noise)) {
      result_.outcome = EstimateOutcome::misfit;
      result_.message = "the outline is missed by " + std::to_string(1e3 * miss) +
                        " mm rms, noise " + std::to_string(1e3 * observation_.noise) + " mm";
    }
  }

  void restore(const Progress& progress) {
    const int iterations = result_.iterations, solves = result_.forward_solves;
    result_ = progress.result;
    result_.iterations = iterations;
    result_.forward_solves = solves;
    u_ = progress.u;
  }

  void set_unknowns(const VecX& u) {
    u_ = u;
    result_.fabric = objective_.space().decode(u.head(objective_.space().size()));
    potential_.set_fabric(result_.fabric);
  }

  double outline_miss() const {
    return std::sqrt((profile_of(result_.equilibrium) - observation_.profile).squaredNorm() /
                     kProfileSize);
  }

  bool same_nodes() const {
    return node_count(profile_of(result_.equilibrium)) == node_count(observation_.profile);
  }

  Guide guide_of(double kappa) const {
    return {harmonics(observation_.profile, start_.harmonics), objective_.centre_of(u_), kappa};
  }

  bool guided_start() {
    result_.kappa = start_.kappa;
    const Guide guide = guide_of(start_.kappa);
    potential_.set_guide(guide);
    ContactDrape start = drape_with_contact(
        potential_, scene_, options_.contact,
        [&](const Potential& potential) { return laid_along(potential, guide); },
        options_.equilibrium);
    result_.equilibrium = std::move(start.equilibrium);
    result_.contact = std::move(start.contact);
    result_.outcome = EstimateOutcome::no_start;
    const bool solved_again = result_.contact.support && options_.contact == ContactMode::automatic;
    result_.forward_solves += solved_again ? 2 : 1;
    return result_.equilibrium.converged();
  }

  Equilibrium laid_along(const Potential& potential, const Guide& guide) const {
    if (start_.bending == 1)
      return solve_under_guide(potential, scene_, guide, options_.equilibrium);
    Potential stiffer = potential;
    Fabric fabric = potential.fabric();
    for (Parameter p : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh})
      fabric[p] *= start_.bending;
    stiffer.set_fabric(fabric);
    const Equilibrium first = solve_under_guide(stiffer, scene_, guide, options_.equilibrium);
    Equilibrium result = solve_equilibrium(potential, first.x, options_.equilibrium);
    result.add_work_of(first);
    result.protocol = first.protocol;
    return result;
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

  Minimum fit_stage(double tolerance, int max_iterations) {
    MinimiseOptions options;
    options.method = options_.method;
    options.max_iterations = std::min(max_iterations, options_.max_iterations);
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

  /// Makes the state at hand the one that the objective knows; it may be of an earlier start.
  bool know_last_drape() {
    if (!result_.equilibrium.converged()) return false;
    potential_.set_fabric(result_.fabric);
    potential_.set_guide(std::nullopt);
    const ParameterSpace& space = objective_.space();
    objective_.start_from(
        potential_,
        make_branch_point(potential_, space, u_.head(space.size()), result_.equilibrium),
        options_.continuation);
    return true;
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
    result_.outline_rms = outline_miss();
    VecX r;
    MatX jacobian;
    result_.log_sd = VecX::Constant(objective_.space().size(), std::nan(""));
    if (result_.outcome == EstimateOutcome::branch_lost || !know_last_drape() ||
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
  GuidedStart start_;
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
    case EstimateOutcome::misfit:
      return "misfit";
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
