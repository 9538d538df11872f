#include "experiments/recovery.h"

#include <cmath>
#include <utility>

#include "core/profile.h"
#include "core/random.h"
#include "experiments/model.h"

namespace drape {
namespace {

constexpr double kSharedBranch = 1e-6;  // [m]
constexpr double kBranchStep = 0.1;     // of a log parameter: small beside the snaps of a drape
constexpr int kNoiseHarmonics = 15;
constexpr double kPi = 3.14159265358979323846;

/// The target's own branch at the first parameters of a fit, if there is one, and whether following
/// it back ends where it began.
struct BranchTest {
  std::optional<Equilibrium> start;
  bool shared = false;
};

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

}  // namespace

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

VecX with_noise(const VecX& profile, double sd, std::uint64_t seed) {
  Random random(seed);
  VecX noise = VecX::Zero(profile.size());
  for (int k = 0; k <= kNoiseHarmonics; ++k) {
    const double phase = random.uniform(0, 2 * kPi);
    for (Eigen::Index i = 0; i < profile.size(); ++i)
      noise[i] += std::cos(
          2 * kPi * k * static_cast<double>(i) / static_cast<double>(profile.size()) + phase);
  }
  return profile +
         sd / std::sqrt((noise.squaredNorm() / static_cast<double>(noise.size()))) * noise;
}

EstimateOptions estimate_options(const Settings& settings) {
  EstimateOptions options;
  options.parameters = settings.estimate.parameters;
  options.method = settings.estimate.method;
  options.loss = settings.estimate.loss;
  options.guide = settings.estimate.guide;
  options.guide_harmonics = settings.estimate.guide_harmonics;
  options.bound_factor = settings.estimate.bounds;
  options.prior_log_sd = settings.estimate.prior_log_sd;
  options.max_iterations = settings.estimate.max_iterations;
  options.contact = settings.contact;
  options.equilibrium = equilibrium_options(settings);
  options.continuation.equilibrium.tolerance = settings.solver.tolerance;
  return options;
}

EstimateRecord recover(const Settings& settings, const Potential& model, const Record& record,
                       const RecordsHeader& header, std::uint64_t seed) {
  const EstimateOptions options = estimate_options(settings);
  OutlineObservation observation;
  observation.noise = settings.estimate.outline_noise;
  observation.profile =
      settings.estimate.add_noise
          ? with_noise(record.observation.profile, observation.noise, seed_of_item(seed, 1))
          : record.observation.profile;
  observation.grid = header.grid;
  observation.coverage = record.observation.coverage;

  const Fabric start = perturbed(record.fabric, settings.estimate, seed_of_item(seed, 2));
  Potential target = model;  // what acted on the target acts on its branch
  target.set_support(record.stats.contact == "support"
                         ? std::optional(support_contact(header.scene))
                         : std::nullopt);
  const BranchTest branch = settings.estimate.start == EstimateStart::continued
                                ? follow_target(target, record, start, options)
                                : BranchTest{};
  const Estimate result = estimate(target, header.scene, observation, start, options,
                                   branch.shared ? branch.start : std::nullopt);
  EstimateRecord kept =
      estimate_record(model, header.scene, result, observation, options.parameters);
  kept.branch_shared = branch.shared;
  return kept;
}

EstimateRecord estimate_record(const Potential& model, const Scene& scene, const Estimate& estimate,
                               const OutlineObservation& observation,
                               const std::vector<Parameter>& parameters) {
  Potential potential = model;
  potential.set_fabric(estimate.fabric);
  potential.set_support(estimate.contact.support ? std::optional(support_contact(scene))
                                                 : std::nullopt);
  EstimateRecord kept;
  kept.fabric = estimate.fabric;
  kept.start = estimate.start;
  kept.outcome = std::string(name(estimate.outcome));
  kept.log_sd = ParameterVector::Constant(std::nan(""));
  if (estimate.log_sd.size() == static_cast<Eigen::Index>(parameters.size()))
    for (size_t i = 0; i < parameters.size(); ++i)
      kept.log_sd[static_cast<int>(parameters[i])] = estimate.log_sd[static_cast<Eigen::Index>(i)];
  kept.positions = estimate.equilibrium.x;
  kept.stats = solve_stats(potential, scene, estimate.equilibrium);
  kept.stats.cpu_seconds = estimate.cpu_seconds;
  kept.forward_solves = estimate.forward_solves;
  kept.outline_rms = estimate.outline_rms;
  kept.start_profile = estimate.start_profile.size() > 0
                           ? estimate.start_profile
                           : VecX::Constant(kProfileSize, std::nan(""));
  Outline outline = trace_outline(model.mesh(), scene, estimate.equilibrium.x);
  kept.drape_coefficient = drape_coefficient(scene, area(outline.points));
  outline.points.rowwise() -= estimate.centre.transpose();  // into the observation's frame
  kept.profile = radial_profile(outline.points).radius;
  kept.node_count = node_count(kept.profile);
  kept.iou =
      intersection_over_union(coverage(outline.points, observation.grid), observation.coverage);
  return kept;
}

}  // namespace drape
