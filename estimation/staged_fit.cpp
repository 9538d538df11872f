#include "estimation/staged_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/coarse_choice.h"
#include "core/drape_protocol.h"
#include "core/guided.h"

namespace drape {
namespace {

constexpr double kOvershootKappa = 1;
constexpr double kLeastHeight = 0.04;  // of a vertex that pops, over its distance from others
constexpr double kNearby = 0.15;       // [rad]
constexpr double kSpread = 5;          // of first parameters, either way
constexpr std::array kPrimes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41};
constexpr double kNearFit = 1e-2, kNearDrape = 1e-4;  // ends of fits are rough; [m]
constexpr double kSameDrape = 1e-5;     // [m]: neighbours differ by tenths of a millimetre
constexpr std::uint64_t kRampSeed = 2;  // of the noise in the flat start

/// The digits of index in base `base`, mirrored at the point.
double radical_inverse(int index, int base) {
  double value = 0, digit = 1;
  for (; index > 0; index /= base) value += (digit /= base) * (index % base);
  return value;
}

}  // namespace

FitState FitState::without_factors() const {
  FitState state = *this;
  for (PictureEstimate& picture : state.pictures) {
    picture.equilibrium.factor.reset();
    picture.equilibrium.preconditioner.reset();
  }
  return state;
}

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
  const VecX z = u.head(space().size());
  state_.fabric = z == space().encode(start_) ? start_ : space().decode(z);  // to the last bit
}

void StagedFit::scatter_unknowns(int index) {
  VecX u = VecX::Zero(objective_.unknowns());
  u.head(space().size()) = space().encode(start_);
  for (int i = 0; i < space().size(); ++i)
    if (is_logarithmic(options_.parameters[static_cast<size_t>(i)]))
      u[i] += std::log(kSpread) * (2 * radical_inverse(index, kPrimes[static_cast<size_t>(i)]) - 1);
  set_unknowns(u);
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
        const auto solve = start.coarse ? solve_under_guide_from_coarse : solve_under_guide;
        if (start.bending == 1) return solve(potential, scene, guide, options_.equilibrium);
        Potential bent = potential;
        bent.set_fabric(stiffer);
        const Equilibrium first = solve(bent, scene, guide, options_.equilibrium);
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
    potential.set_fabric(state_.fabric);
    potential.set_guide(kappa > 0 ? std::optional(guide_of(i, kappa)) : std::nullopt);
    drapes.push_back(
        solve_equilibrium(potential, state_.pictures[i].equilibrium.x, options_.equilibrium));
    ++solves_;
  }
  return replace_drapes(std::move(drapes), kappa);
}

/// Makes the drapes under guides of strength kappa those at hand, if all are equilibria.
bool StagedFit::replace_drapes(std::vector<Equilibrium> drapes, double kappa) {
  for (size_t i = 0; i < pictures(); ++i) {
    drapes[i].protocol = state_.pictures[i].equilibrium.protocol;
    if (drapes[i].converged()) continue;
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

bool StagedFit::lay_and_release(const GuidedStart& start) {
  return lay_along(start) && set_guides(start.kappa / 10) && set_guides(0);
}

bool StagedFit::overshoot(double factor) {
  std::vector<Equilibrium> drapes;
  for (size_t i = 0; i < pictures(); ++i) {
    const Scene& scene = picture(i).scene;
    OutlineObservation beyond = picture(i).seen;
    beyond.profile += factor * (beyond.profile - profile_of(i));
    beyond.profile = beyond.profile.cwiseMax(scene.support_radius).cwiseMin(scene.specimen_radius);
    Potential& potential = potentials_[i];
    potential.set_fabric(state_.fabric);
    potential.set_guide(guide_towards(beyond, scene, objective_.placement_at(i, state_.u),
                                      guide_harmonics_, kOvershootKappa));
    const Equilibrium pulled =
        solve_equilibrium(potential, state_.pictures[i].equilibrium.x, options_.equilibrium);
    potential.set_guide(std::nullopt);
    drapes.push_back(solve_equilibrium(potential, pulled.x, options_.equilibrium));
    solves_ += 2;
  }
  return replace_drapes(std::move(drapes), 0);
}

std::vector<PicturePop> StagedFit::promising_pops() const {
  std::vector<std::pair<double, PicturePop>> weighed;
  for (size_t i = 0; i < pictures(); ++i) {
    const OutlineObservation& seen = picture(i).seen;
    const VecX missed = (profile_of(i) - seen.profile).cwiseAbs2();
    const VecX& x = state_.pictures[i].equilibrium.x;
    const Placement placement = objective_.placement_at(i, state_.u);
    for (const Pop& pop : poppable(potentials_[i].mesh(), x, kLeastHeight)) {
      const VecX vertex = seen.camera.seen(x.segment<3>(3 * pop.vertex));
      const Points2 point = placement.seen(vertex.head<2>().transpose());
      const double azimuth = std::atan2(point(0, 1), point(0, 0));
      double near = 0;
      for (Eigen::Index k = 0; k < missed.size(); ++k) {
        const double away =
            std::remainder(azimuth - 2 * std::numbers::pi * static_cast<double>(k) / kProfileSize,
                           2 * std::numbers::pi);
        near += missed[k] * std::exp(-0.5 * away * away / (kNearby * kNearby));
      }
      weighed.push_back({near, {i, pop}});
    }
  }
  std::ranges::stable_sort(weighed, std::greater{}, &std::pair<double, PicturePop>::first);
  std::vector<PicturePop> order;
  for (const auto& [near, pop] : weighed) order.push_back(pop);
  return order;
}

bool StagedFit::pop(const PicturePop& which) {
  std::vector<Equilibrium> drapes;
  for (const PictureEstimate& own : state_.pictures) drapes.push_back(own.equilibrium);
  Equilibrium& drape = drapes[which.picture];
  Potential& potential = potentials_[which.picture];
  potential.set_fabric(state_.fabric);
  potential.set_guide(std::nullopt);
  VecX x = drape.x;
  x.segment<3>(3 * which.pop.vertex) = which.pop.to;
  drape = solve_equilibrium(potential, x, options_.equilibrium, drape.preconditioner);
  ++pops_;
  return replace_drapes(std::move(drapes), 0);
}

Equilibrium StagedFit::drape_freely(size_t i, FreeDrape how) const {
  const Potential& potential = potentials_[i];
  const Scene& scene = picture(i).scene;
  const EquilibriumOptions& options = options_.equilibrium;
  const Guide outline = guide_of(i, 0);
  switch (how) {
    case FreeDrape::lobes: {
      const int nodes = node_count(picture(i).seen.profile);
      const Harmonics& radius = outline.radius;
      const bool folded = nodes > 0 && nodes < radius.a.size();
      const double phase = folded ? std::atan2(radius.b[nodes], radius.a[nodes]) / nodes : 0;
      return drape_by_lobes(potential, scene, nodes, phase, options);
    }
    case FreeDrape::outline:
      return chosen_on_coarse_mesh(
          potential, options, [&](const Potential& coarse, const EquilibriumOptions& loose) {
            return solve_stiffening(coarse, scene,
                                    state_from_outline(coarse.mesh(), scene, outline), loose);
          });
    case FreeDrape::ramp:
      return drape_by_ramp(potential, kRampSeed, options);
  }
  throw std::logic_error("a free drape without a function");
}

bool StagedFit::drape_freely(FreeDrape how) {
  std::vector<Equilibrium> drapes;
  for (size_t i = 0; i < pictures(); ++i) {
    potentials_[i].set_fabric(state_.fabric);
    potentials_[i].set_guide(std::nullopt);
    drapes.push_back(drape_freely(i, how));
    ++solves_;
  }
  return replace_drapes(std::move(drapes), 0);
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

bool StagedFit::is_at(const FitState& state) const {
  return state_.u == state.u && state_.kappa == state.kappa && drapes_within(kSameDrape, state);
}

bool StagedFit::drapes_within(double distance, const FitState& of) const {
  bool within = true;
  for (size_t i = 0; within && i < pictures(); ++i)
    within =
        largest_distance(state_.pictures[i].equilibrium.x, of.pictures[i].equilibrium.x) < distance;
  return within;
}

bool StagedFit::residuals(VecX& r, MatX* jacobian) {
  return objective_.residuals_at(state_.u, r, jacobian);
}

VecX StagedFit::profile_of(size_t i) const {
  const VecX x = picture(i).seen.camera.seen(state_.pictures[i].equilibrium.x);
  const Outline outline = trace_outline(potentials_[i].mesh(), picture(i).scene, x);
  return radial_profile(objective_.placement_at(i, state_.u).seen(outline.points)).radius;
}

bool StagedFit::is_near(const FitState& state) const {
  return (state_.u - state.u).cwiseAbs().maxCoeff() < kNearFit && drapes_within(kNearDrape, state);
}

double StagedFit::largest_miss() const {
  double largest = 0;
  for (size_t i = 0; i < pictures(); ++i)
    largest = std::max(largest, rms_of(i) / picture(i).seen.noise);
  return largest;
}

double StagedFit::largest_rms() const {
  double largest = 0;
  for (size_t i = 0; i < pictures(); ++i) largest = std::max(largest, rms_of(i));
  return largest;
}

double StagedFit::rms_of(size_t i) const {
  return std::sqrt((profile_of(i) - picture(i).seen.profile).squaredNorm() / kProfileSize);
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
    own.outline_rms = rms_of(i);
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
  else
    jacobian.topRows(objective_.picture_residuals()) /= std::max(1.0, largest_miss());
  return laplace(space(), state_.u.head(space().size()), jacobian,
                 options_.prior ? options_.prior->covariance : MatX());
}

}  // namespace drape
