#include "estimation/estimate.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/cpu_clock.h"
#include "core/guided.h"

namespace drape {
namespace {

constexpr double kStageTolerance = 1e-3;  // relative cost change that ends a guided fit
constexpr double kFinalTolerance =
    1e-6;  // and the last one, far below what noise leaves of the cost

/// One estimation from start to end; each method is one stage.
class Estimation {
 public:
  Estimation(const std::vector<Picture>& pictures, const Fabric& start,
             const EstimateOptions& options)
      : options_(options),
        guided_(!pictures.front().start_state),
        objective_(pictures, {options.parameters, start}, options.prior, options.misfit,
                   options.max_solves * static_cast<int>(pictures.size())) {
    result_.start = result_.fabric = start;
    result_.pictures.resize(pictures.size());
    u_ = VecX::Zero(objective_.unknowns());
    u_.head(space().size()) = space().encode(start);
    for (const Picture& picture : pictures) {
      potentials_.push_back(picture.model);
      potentials_.back().set_fabric(start);
      potentials_.back().set_guide(std::nullopt);
    }
  }

  Estimate run() {
    const double start_time = thread_cpu_seconds();
    fit();
    result_.forward_solves += objective_.solves();
    result_.cpu_seconds = thread_cpu_seconds() - start_time;
    return std::move(result_);
  }

 private:
  const ParameterSpace& space() const { return objective_.space(); }
  size_t pictures() const { return potentials_.size(); }
  const Picture& picture(size_t i) const { return objective_.picture(i); }

  void fit() {
    bool started = true;
    for (size_t i = 0; i < pictures(); ++i) started = start(i) && started;
    if (!started) {
      result_.outcome = EstimateOutcome::no_start;
      return;
    }
    if (guided_)
      for (double kappa : options_.guide) {
        if (!set_guides(kappa)) return;
        fit_stage(kStageTolerance);
      }
    if (!set_guides(0)) return;
    const Minimum minimum = fit_stage(kFinalTolerance);
    result_.cost = minimum.cost;
    result_.outcome =
        minimum.converged ? EstimateOutcome::succeeded : EstimateOutcome::not_converged;
    finish();
  }

  static std::string named(size_t i) { return "picture " + std::to_string(i + 1); }

  Guide guide_of(size_t i, double kappa) const {
    return guide_towards(picture(i).seen, objective_.placement_at(i, u_), options_.guide_harmonics,
                         kappa);
  }

  /// The first drape of a picture; false when there is none.
  bool start(size_t i) {
    PictureEstimate& own = result_.pictures[i];
    if (guided_) {
      if (!guided_start(i)) {
        result_.message = "no guided drape for " + named(i);
        return false;
      }
    } else {
      own.equilibrium = *picture(i).start_state;
      own.contact.support = potentials_[i].support().has_value();
      own.contact.reason = "As in the state that the fit starts from.";
    }
    own.start_profile = profile_of(i);
    return true;
  }

  bool guided_start(size_t i) {
    PictureEstimate& own = result_.pictures[i];
    const double kappa = options_.guide.empty() ? 1 : options_.guide.front();
    result_.kappa = kappa;
    const Guide guide = guide_of(i, kappa);
    potentials_[i].set_guide(guide);
    ContactDrape start = drape_with_contact(
        potentials_[i], picture(i).scene, options_.contact,
        [&](const Potential& potential) {
          return solve_under_guide(potential, picture(i).scene, guide, options_.equilibrium);
        },
        options_.equilibrium);
    own.equilibrium = std::move(start.equilibrium);
    own.contact = std::move(start.contact);
    const bool solved_again = own.contact.support && options_.contact == ContactMode::automatic;
    result_.forward_solves += solved_again ? 2 : 1;
    return own.equilibrium.converged();
  }

  /// The drapes at the current unknowns under other guides; false when one has none near-by.
  bool set_guides(double kappa) {
    std::vector<Equilibrium> drapes;
    for (size_t i = 0; i < pictures(); ++i) {
      Potential& potential = potentials_[i];
      const Equilibrium& last = result_.pictures[i].equilibrium;
      potential.set_fabric(result_.fabric);
      potential.set_guide(kappa > 0 ? std::optional(guide_of(i, kappa)) : std::nullopt);
      drapes.push_back(solve_equilibrium(potential, last.x, options_.equilibrium));
      drapes.back().protocol = last.protocol;
      ++result_.forward_solves;
      if (drapes.back().converged()) continue;
      result_.outcome = EstimateOutcome::branch_lost;
      result_.message = "no equilibrium at kappa = " + std::to_string(kappa) + " for " + named(i);
      finish();
      return false;
    }
    result_.kappa = kappa;
    for (size_t i = 0; i < pictures(); ++i) {
      result_.pictures[i].equilibrium = drapes[i];
      objective_.start_from(
          i, potentials_[i],
          make_branch_point(potentials_[i], space(), u_.head(space().size()), std::move(drapes[i])),
          kappa > 0 ? guided_continuation() : options_.continuation);
    }
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
    const VecX z = space().encode(result_.start);
    options.upper = objective_.bounds();
    options.lower = -options.upper;
    for (int i = 0; i < space().size(); ++i) {
      const Parameter parameter = options_.parameters[static_cast<size_t>(i)];
      const double reach = std::log(options_.bound_factor);
      options.lower[i] = is_logarithmic(parameter) ? z[i] - reach : 0;
      options.upper[i] = is_logarithmic(parameter) ? z[i] + reach : 1;
    }
    const Minimum minimum = minimise(objective_, u_, options);
    if (keep_drapes(minimum.u)) u_ = minimum.u;
    result_.iterations += minimum.iterations;
    result_.message = minimum.message;
    return minimum;
  }

  /// The drapes of all pictures at u, if there are any.
  bool keep_drapes(const VecX& u) {
    std::vector<Equilibrium> drapes;
    for (size_t i = 0; i < pictures(); ++i) {
      const BranchPoint* drape = objective_.drape_at(i, u);
      if (drape == nullptr) return false;
      drapes.push_back(drape->equilibrium);
    }
    for (size_t i = 0; i < pictures(); ++i) result_.pictures[i].equilibrium = std::move(drapes[i]);
    result_.fabric = space().decode(u.head(space().size()));
    return true;
  }

  VecX profile_of(size_t i) const {
    const Outline outline =
        trace_outline(potentials_[i].mesh(), picture(i).scene, result_.pictures[i].equilibrium.x);
    return radial_profile(objective_.placement_at(i, u_).seen(outline.points)).radius;
  }

  /// Looks at the last state of a picture. What acts on it was decided at the start.
  void check_last_contact(size_t i) {
    PictureEstimate& own = result_.pictures[i];
    const VecX& x = own.equilibrium.x;
    std::string reason = std::move(own.contact.reason);
    own.contact = check_contact(potentials_[i], picture(i).scene, x);
    own.contact.reason = std::move(reason);
    own.contact_doubtful = would_choose_otherwise(potentials_[i], own.contact, x);
  }

  void finish() {
    for (size_t i = 0; i < pictures(); ++i) {
      check_last_contact(i);
      PictureEstimate& own = result_.pictures[i];
      own.placement = objective_.placement_at(i, u_);
      own.outline_rms =
          std::sqrt((profile_of(i) - picture(i).seen.profile).squaredNorm() / kProfileSize);
    }
    VecX r;
    MatX jacobian;
    if (result_.outcome == EstimateOutcome::branch_lost ||
        !objective_.residuals_at(u_, r, &jacobian))
      jacobian.setZero(0, objective_.unknowns());  // nothing is known
    result_.posterior = laplace(space(), u_.head(space().size()), jacobian,
                                options_.prior ? options_.prior->covariance : MatX());
  }

  EstimateOptions options_;
  bool guided_;
  DrapeObjective objective_;
  std::vector<Potential> potentials_;  // with the last guides
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

Estimate estimate(const std::vector<Picture>& pictures, const Fabric& start,
                  const EstimateOptions& options) {
  if (pictures.empty()) throw std::invalid_argument("estimate: no picture of the fabric is given");
  if (options.parameters.empty())
    throw std::invalid_argument("estimate: no parameters to estimate");
  for (const Picture& picture : pictures) {
    if (picture.start_state.has_value() != pictures.front().start_state.has_value())
      throw std::invalid_argument("estimate: some pictures have a start state and some have not");
    if (picture.start_state && !picture.start_state->converged())
      throw std::invalid_argument("estimate: the start state is not a converged equilibrium");
  }
  return Estimation(pictures, start, options).run();
}

}  // namespace drape
