#include "experiments/recovery.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/contour.h"
#include "core/profile.h"
#include "core/random.h"
#include "estimation/bending_rigidity.h"
#include "experiments/dataset_fabrics.h"
#include "experiments/model.h"

namespace drape {
namespace {

constexpr double kSharedBranch = 1e-6;  // [m]
constexpr double kBranchStep = 0.1;     // of a log parameter: small beside the snaps of a drape
constexpr double kPi = 3.14159265358979323846;

/// The first parameters of a fit and the weight as the record has it.
Fabric first_fabric(const EstimateSettings& settings, const Record& record,
                    const TagPrior& tag_prior, std::uint64_t seed) {
  switch (settings.first) {
    case FirstParameters::perturbed:
      return perturbed(record.fabric, settings, seed);
    case FirstParameters::weight:
      return first_parameters(Structure::woven, record.fabric.areal_density);
    case FirstParameters::tag: {
      const std::vector<Parameter> all(all_parameters().begin(), all_parameters().end());
      const Tag tag = tag_of(record);
      Fabric fabric = ParameterSpace{all, record.fabric}.decode(tag_prior(all, tag).mean);
      fabric.areal_density = tag.areal_density;  // but for rounding
      return fabric;
    }
  }
  throw std::logic_error("first parameters without a function");
}

}  // namespace

Potential as_draped(Potential model, const Record& record, const Scene& scene) {
  model.set_support(record.stats.contact == "support" ? std::optional(support_contact(scene))
                                                      : std::nullopt);
  return model;
}

BranchTest follow_target(Potential potential, const Record& record, const Fabric& start,
                         const EstimateOptions& options) {
  BranchTest test;
  ContinuationOptions patient{.largest_step = kBranchStep};
  patient.equilibrium.tolerance = options.equilibrium.tolerance;
  if (!converged(record)) return test;
  potential.set_fabric(record.fabric);
  const Equilibrium target = solve_equilibrium(potential, record.positions, options.equilibrium);
  if (!target.converged() || largest_distance(target.x, record.positions) > kSharedBranch)
    return test;
  const ParameterSpace space{options.parameters, record.fabric};
  const VecX truth = space.encode(record.fabric), first = space.encode(start);
  const auto there = follow_branch(
      potential, space, make_branch_point(potential, space, truth, target), first, patient);
  if (!there) return test;
  const auto back = follow_branch(potential, space, *there, truth, patient);
  test.start = there->equilibrium;
  test.start->protocol = record.stats.protocol + ", continued";
  test.shared = back && largest_distance(back->equilibrium.x, record.positions) < kSharedBranch;
  return test;
}

Fabric perturbed(const Fabric& truth, const EstimateSettings& settings, std::uint64_t seed) {
  Random random(seed);
  Fabric fabric = truth;
  for (Parameter p : settings.parameters) {
    if (!is_logarithmic(p)) continue;
    const double most = std::log(settings.perturbation);
    const double log_factor = settings.perturb == Perturb::up ? most
                              : settings.perturb == Perturb::either_way
                                  ? random.sign() * most
                                  : random.uniform(-most, most);
    fabric[p] *= std::exp(log_factor);
  }
  return fabric;
}

VecX with_noise(const VecX& profile, double sd, int harmonic_count, std::uint64_t seed) {
  Random random(seed);
  VecX noise = VecX::Zero(profile.size());
  for (int k = 0; k <= harmonic_count; ++k) {
    // the mean is one value and each further harmonic two: all have the same variance
    const double amplitude = k == 0 ? std::sqrt(0.5) : 1;
    const double phase = random.uniform(0, 2 * kPi);
    for (Eigen::Index i = 0; i < profile.size(); ++i)
      noise[i] += amplitude * std::cos(2 * kPi * k * static_cast<double>(i) /
                                           static_cast<double>(profile.size()) +
                                       phase);
  }
  return profile +
         sd / std::sqrt((noise.squaredNorm() / static_cast<double>(noise.size()))) * noise;
}

EstimateOptions estimate_options(const Settings& settings) {
  EstimateOptions options;
  options.parameters = settings.estimate.parameters;
  options.method = settings.estimate.method;
  options.misfit = {settings.estimate.loss, settings.estimate.huber};
  options.guide = settings.estimate.guide;
  options.guide_harmonics = settings.estimate.guide_harmonics;
  options.max_restarts = settings.estimate.max_restarts;
  options.max_moves = settings.estimate.max_moves;
  options.max_pops = settings.estimate.max_pops;
  options.max_solves = settings.estimate.max_solves;
  options.bound_factor = settings.estimate.bounds;
  options.max_iterations = settings.estimate.max_iterations;
  options.contact = settings.contact;
  options.equilibrium = equilibrium_options(settings);
  options.continuation.equilibrium.tolerance = settings.solver.tolerance;
  return options;
}

std::optional<Prior> fit_prior(const Settings& settings, PriorKind kind, Structure structure,
                               const Fabric& start) {
  const std::vector<Parameter>& parameters = settings.estimate.parameters;
  switch (kind) {
    case PriorKind::none:
      return std::nullopt;
    case PriorKind::start:
      return prior_about({parameters, start}, start, settings.estimate.prior_log_sd);
    case PriorKind::weight:
      return prior_from_weight(parameters, structure, start.areal_density);
    case PriorKind::tag:
      break;
  }
  throw std::logic_error("a prior without a function");
}

EstimateRecord recover(const Settings& settings, const Potential& model, const Record& record,
                       const RecordsHeader& header, const TagPrior& tag_prior, std::uint64_t seed) {
  EstimateOptions options = estimate_options(settings);
  OutlineObservation observation;
  observation.noise = settings.estimate.outline_noise;
  observation.noise_harmonics = settings.estimate.noise_harmonics;
  observation.profile = settings.estimate.add_noise
                            ? with_noise(record.observation.profile, observation.noise,
                                         observation.noise_harmonics, seed_of_item(seed, 1))
                            : record.observation.profile;
  observation.grid = header.grid;
  observation.coverage = record.observation.coverage;
  if (options.misfit.loss == OutlineLoss::signed_distance)
    observation.outline = contour(observation.coverage, observation.grid);

  const Fabric start = first_fabric(settings.estimate, record, tag_prior, seed_of_item(seed, 2));
  const Structure structure =
      record.category.empty() ? Structure::woven : structure_from_category(record.category);
  options.prior = settings.estimate.prior == PriorKind::tag
                      ? tag_prior(options.parameters, tag_of(record))
                      : fit_prior(settings, settings.estimate.prior, structure, start);
  const Potential target = as_draped(model, record, header.scene);
  const BranchTest branch = settings.estimate.start == EstimateStart::continued
                                ? follow_target(target, record, start, options)
                                : BranchTest{};
  const Picture picture{target, header.scene, observation,
                        branch.shared ? branch.start : std::nullopt};
  const Estimate result = estimate({picture}, start, options);
  EstimateRecord kept =
      estimate_record(picture, result.pictures.front(), result, options.parameters);
  kept.branch_shared = branch.shared;
  return kept;
}

EstimateRecord estimate_record(const Picture& picture, const PictureEstimate& drape,
                               const Estimate& estimate, const std::vector<Parameter>& parameters) {
  Potential potential = picture.model;
  potential.set_fabric(estimate.fabric);
  potential.set_support(drape.contact.support ? std::optional(support_contact(picture.scene))
                                              : std::nullopt);
  EstimateRecord kept;
  kept.fabric = estimate.fabric;
  kept.start = estimate.start;
  kept.outcome = std::string(name(estimate.outcome));
  const Posterior& posterior = estimate.posterior;
  if (posterior.log_sd.size() > 0) {
    for (size_t i = 0; i < parameters.size(); ++i) {
      kept.log_sd[static_cast<int>(parameters[i])] = posterior.log_sd[static_cast<Eigen::Index>(i)];
      kept.picture_share[static_cast<int>(parameters[i])] =
          posterior.picture_share[static_cast<Eigen::Index>(i)];
    }
    kept.rigidity_log_sd.head<3>() = posterior.rigidity_log_sd;
  }
  kept.rigidity.head<3>() = effective_rigidity(estimate.fabric);
  kept.positions = drape.equilibrium.x;
  kept.stats = solve_stats(potential, picture.scene, drape.equilibrium);
  kept.stats.cpu_seconds = estimate.cpu_seconds;
  kept.forward_solves = estimate.forward_solves;
  kept.outline_rms = drape.outline_rms;
  kept.centre.head<2>() = drape.placement.centre;
  kept.weft_angle = drape.placement.weft_angle;
  kept.log_scale = drape.placement.log_scale;
  kept.start_profile = drape.start_profile.size() > 0 ? drape.start_profile
                                                      : VecX::Constant(kProfileSize, std::nan(""));
  const Outline outline = trace_outline(potential.mesh(), picture.scene, drape.equilibrium.x);
  kept.drape_coefficient = drape_coefficient(picture.scene, area(outline.points));
  const VecX x = picture.seen.camera.seen(drape.equilibrium.x);
  const Points2 seen =
      drape.placement.seen(trace_outline(potential.mesh(), picture.scene, x).points);
  kept.profile = radial_profile(seen).radius;
  kept.node_count = node_count(kept.profile);
  kept.iou = intersection_over_union(coverage(seen, picture.seen.grid), picture.seen.coverage);
  return kept;
}

}  // namespace drape
