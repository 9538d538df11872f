#include "estimation/staged_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/guided.h"

namespace drape {

StagedFit::StagedFit(const std::vector<Picture>& pictures, const Fabric& start,
                     const EstimateOptions& options)
    : options_(options),
      start_(start),
      objective_(pictures, {options.parameters, start}, options.prior, options.misfit,
                 options.max_solves * static_cast<int>(pictures.size())),
      guide_harmonics_(options.guide_harmonics) {
  state_.fabric = start;
  state_.pictures.resize(pictures.size());
  state_.u = VecX::Zero(objective_.unknowns());
  state_.u.head(space().size()) = space().encode(start);
  for (const Picture& picture : pictures) {
    potentials_.push_back(picture.model);
    potentials_.back().set_fabric(start);
    potentials_.back().set_guide(std::nullopt);
  }
}

void StagedFit::set_unknowns(const VecX& u) {
  if (u == state_.u) return;
  state_.u = u;
  state_.fabric = space().decode(u.head(space().size()));
}

Guide StagedFit::guide_of(size_t i, double kappa) const {
  return guide_towards(picture(i).seen, picture(i).scene, objective_.placement_at(i, state_.u),
                       guide_harmonics_, kappa);
}

bool StagedFit::lay_along(const GuidedStart& start) {
  guide_harmonics_ = start.harmonics;
  state_.kappa = start.kappa;
  for (size_t i = 0; i < pictures(); ++i)
    if (!lay_along(i, start)) {
      state_.message = "no guided drape for picture " + std::to_string(i + 1);
      return false;
    }
  return true;
}

bool StagedFit::lay_along(size_t i, const GuidedStart& start) {
  PictureEstimate& own = state_.pictures[i];
  const Scene& scene = picture(i).scene;
  const Guide guide = guide_of(i, start.kappa);
  potentials_[i] = picture(i).model;
  potentials_[i].set_fabric(state_.fabric);
  potentials_[i].set_guide(guide);
  Fabric stiffer = state_.fabric;
  for (const Parameter p : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh})
    stiffer[p] *= start.bending;
  ContactDrape draped = drape_with_contact(
      potentials_[i], scene, options_.contact,
      [&](const Potential& potential) {
        if (start.bending == 1)
          return solve_under_guide(potential, scene, guide, options_.equilibrium);
        Potential bent = potential;
        bent.set_fabric(stiffer);
        const Equilibrium first = solve_under_guide(bent, scene, guide, options_.equilibrium);
        Equilibrium result = solve_equilibrium(potential, first.x, options_.equilibrium);
        result.add_work_of(first);
        result.protocol = first.protocol;
        return result;
      },
      options_.equilibrium);
  own.equilibrium = std::move(draped.equilibrium);
  own.contact = std::move(draped.contact);
  const bool solved_again = own.contact.support && options_.contact == ContactMode::automatic;
  solves_ += solved_again ? 2 : 1;
  if (!own.equilibrium.converged()) return false;
  if (own.start_profile.size() == 0) own.start_profile = profile_of(i);
  return true;
}

void StagedFit::take_start_states() {
  for (size_t i = 0; i < pictures(); ++i) {
    PictureEstimate& own = state_.pictures[i];
    own.equilibrium = *picture(i).start_state;
    own.contact.support = potentials_[i].support().has_value();
    own.contact.reason = "As in the state that the fit starts from.";
    own.start_profile = profile_of(i);
  }
}

bool StagedFit::set_guides(double kappa) {
  std::vector<Equilibrium> drapes;
  for (size_t i = 0; i < pictures(); ++i) {
    Potential& potential = potentials_[i];
    const Equilibrium& last = state_.pictures[i].equilibrium;
    potential.set_fabric(state_.fabric);
    potential.set_guide(kappa > 0 ? std::optional(guide_of(i, kappa)) : std::nullopt);
    drapes.push_back(solve_equilibrium(potential, last.x, options_.equilibrium));
    drapes.back().protocol = last.protocol;
    ++solves_;
    if (drapes.back().converged()) continue;
    state_.message = "no equilibrium at kappa = " + std::to_string(kappa) + " for picture " +
                     std::to_string(i + 1);
    return false;
  }
  state_.kappa = kappa;
  for (size_t i = 0; i < pictures(); ++i) {
    state_.pictures[i].equilibrium = std::move(drapes[i]);
    make_known(i);
  }
  return true;
}

/// A guide holds the outline while the cloth below snaps from one state to the next: such steps
/// count, for the outline hardly changes and the branch is chosen only when the guide is gone.
ContinuationOptions StagedFit::continuation() const {
  ContinuationOptions along = options_.continuation;
  if (state_.kappa > 0) along.largest_deviation = std::numeric_limits<double>::infinity();
  return along;
}

/// Makes the drape at hand the one that the objective knows.
void StagedFit::make_known(size_t i) {
  objective_.start_from(i, potentials_[i],
                        make_branch_point(potentials_[i], space(), state_.u.head(space().size()),
                                          state_.pictures[i].equilibrium),
                        continuation());
}

bool StagedFit::minimise(double tolerance, int max_iterations) {
  MinimiseOptions options;
  options.method = options_.method;
  options.max_iterations = std::min(max_iterations, options_.max_iterations);
  options.function_tolerance = tolerance;
  const VecX z = space().encode(start_);
  options.upper = objective_.bounds();
  options.lower = -options.upper;
  const double reach = std::log(options_.bound_factor);
  for (int i = 0; i < space().size(); ++i) {
    const bool by_factor = is_logarithmic(options_.parameters[static_cast<size_t>(i)]);
    options.lower[i] = by_factor ? z[i] - reach : 0;
    options.upper[i] = by_factor ? z[i] + reach : 1;
  }
  const Minimum minimum = drape::minimise(objective_, state_.u, options);
  if (keep_drapes(minimum.u)) state_.u = minimum.u;
  iterations_ += minimum.iterations;
  state_.message = minimum.message;
  state_.cost = state_.kappa > 0 ? std::numeric_limits<double>::infinity() : minimum.cost;
  return minimum.converged;
}

/// The drapes of all pictures at u, if there are any.
bool StagedFit::keep_drapes(const VecX& u) {
  std::vector<Equilibrium> drapes;
  for (size_t i = 0; i < pictures(); ++i) {
    const BranchPoint* drape = objective_.drape_at(i, u);
    if (drape == nullptr) return false;
    drapes.push_back(drape->equilibrium);
  }
  for (size_t i = 0; i < pictures(); ++i) state_.pictures[i].equilibrium = std::move(drapes[i]);
  state_.fabric = space().decode(u.head(space().size()));
  return true;
}

VecX StagedFit::profile_of(size_t i) const {
  const VecX x = picture(i).seen.camera.seen(state_.pictures[i].equilibrium.x);
  const Outline outline = trace_outline(potentials_[i].mesh(), picture(i).scene, x);
  return radial_profile(objective_.placement_at(i, state_.u).seen(outline.points)).radius;
}

double StagedFit::largest_miss() const {
  double largest = 0;
  for (size_t i = 0; i < pictures(); ++i) {
    const OutlineObservation& seen = picture(i).seen;
    const double rms = std::sqrt((profile_of(i) - seen.profile).squaredNorm() / kProfileSize);
    largest = std::max(largest, rms / seen.noise);
  }
  return largest;
}

bool StagedFit::same_nodes() const {
  for (size_t i = 0; i < pictures(); ++i)
    if (node_count(profile_of(i)) != node_count(picture(i).seen.profile)) return false;
  return true;
}

void StagedFit::examine() {
  for (size_t i = 0; i < pictures(); ++i) {
    PictureEstimate& own = state_.pictures[i];
    const VecX& x = own.equilibrium.x;
    std::string reason = std::move(own.contact.reason);  // what acted was decided at the start
    Potential& potential = potentials_[i];
    potential.set_fabric(state_.fabric);
    potential.set_support(own.contact.support ? std::optional(support_contact(picture(i).scene))
                                              : std::nullopt);
    own.contact = check_contact(potential, picture(i).scene, x);
    own.contact.reason = std::move(reason);
    own.contact_doubtful = would_choose_otherwise(potential, own.contact, x);
    own.placement = objective_.placement_at(i, state_.u);
    own.outline_rms =
        std::sqrt((profile_of(i) - picture(i).seen.profile).squaredNorm() / kProfileSize);
  }
}

Posterior StagedFit::posterior() {
  bool known = state_.kappa == 0;
  for (size_t i = 0; known && i < pictures(); ++i) {
    const PictureEstimate& own = state_.pictures[i];
    known = own.equilibrium.converged();
    if (!known) break;
    potentials_[i].set_fabric(state_.fabric);
    potentials_[i].set_guide(std::nullopt);
    make_known(i);  // the state may be that of an earlier start
  }
  VecX r;
  MatX jacobian;
  if (!known || !objective_.residuals_at(state_.u, r, &jacobian))
    jacobian.setZero(0, objective_.unknowns());  // nothing is known
  return laplace(space(), state_.u.head(space().size()), jacobian,
                 options_.prior ? options_.prior->covariance : MatX());
}

}  // namespace drape
