// kind = "identifiability": what the outline of a drape says of each parameter, and which further
// experiment would say more.
//
// At random fabrics of the measured distribution the whitened Jacobian of the outline is taken at
// the truth (no fit, no noise drawn) for several experiments on one fabric: one picture, two drapes
// whose folds lie otherwise to the warp, three sizes of specimen, and both. Laplace's covariance
// without a prior on the fabric (posterior.h) then gives the standard deviation of every log
// parameter and the directions that are seen best and worst; the centre of every picture and its
// scale are unknown as [photograph] says.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>

#include "core/drape_protocol.h"
#include "core/durable_file.h"
#include "estimation/drape_objective.h"
#include "estimation/posterior.h"
#include "experiments/fabric_distribution.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/statistics.h"
#include "experiments/summary.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

/// One drape of an experiment.
struct Specimen {
  double radius;        ///< [m]
  bool turned = false;  ///< its folds lie half a wave further around
};

struct ExperimentDesign {
  const char* name;
  std::vector<Specimen> specimens;
};

std::vector<ExperimentDesign> designs() {
  return {{"one picture", {{0.15}}},
          {"two drapes", {{0.15}, {0.15, true}}},
          {"three sizes", {{0.12}, {0.15}, {0.18}}},
          {"three sizes, two drapes each",
           {{0.12}, {0.15}, {0.18}, {0.12, true}, {0.15, true}, {0.18, true}}}};
}

/// The specimen of every radius, made once.
struct SpecimenModel {
  Scene scene;
  std::shared_ptr<const Discretization> discretization;
};

std::vector<std::pair<double, SpecimenModel>> specimen_models(const Settings& settings) {
  std::vector<std::pair<double, SpecimenModel>> models;
  for (const double radius : {0.12, 0.15, 0.18}) {
    Settings of_radius = settings;
    of_radius.scene.specimen_radius = radius;
    models.push_back({radius, {of_radius.scene, make_discretization(of_radius)}});
  }
  return models;
}

/// A picture of the fabric's drape and that drape's point on its branch.
struct SeenDrape {
  Picture picture;
  BranchPoint point;
};

SeenDrape see(const Settings& settings, const SpecimenModel& model, const Fabric& fabric,
              bool turned, const ParameterSpace& space) {
  Potential potential = make_potential(model.discretization, fabric, settings);
  const double phase =
      settings.start.phase + (turned ? std::numbers::pi / settings.start.lobes : 0);
  Settings here = settings;
  here.scene = model.scene;
  const ContactDrape draped = drape(here, potential, [&](const Potential& free) {
    return drape_by_lobes(free, model.scene, settings.start.lobes, phase,
                          equilibrium_options(settings));
  });
  const Equilibrium& equilibrium = draped.equilibrium;
  if (!equilibrium.converged())
    throw std::runtime_error("drape of radius " + std::to_string(model.scene.specimen_radius) +
                             " m: " + std::string(name(equilibrium.status)));
  Picture picture{potential, model.scene, {}};
  const Outline outline = trace_outline(potential.mesh(), model.scene, equilibrium.x);
  picture.seen.profile = radial_profile(outline.points).radius;
  picture.seen.noise = settings.estimate.outline_noise;
  picture.seen.noise_harmonics = settings.estimate.noise_harmonics;
  picture.seen.centre_known = false;
  picture.seen.scale_log_sd = settings.photograph.scale_log_sd;
  BranchPoint point = make_branch_point(potential, space, space.encode(fabric), equilibrium);
  return {std::move(picture), std::move(point)};
}

/// What an experiment says of the fabric.
Json information(const ParameterSpace& space, const std::vector<SeenDrape>& drapes) {
  std::vector<Picture> pictures;
  for (const SeenDrape& drape : drapes) pictures.push_back(drape.picture);
  DrapeObjective objective(pictures, space, std::nullopt, {}, 1);
  for (size_t i = 0; i < drapes.size(); ++i)
    objective.start_from(i, drapes[i].picture.model, drapes[i].point, {});
  VecX u = VecX::Zero(objective.unknowns()), r;
  u.head(space.size()) = drapes.front().point.z;
  MatX jacobian;
  if (!objective.residuals_at(u, r, &jacobian))
    throw std::logic_error("the drapes of an experiment are not known to its objective");
  const Posterior posterior = laplace(space, u.head(space.size()), jacobian, {});
  Json said;
  for (int i = 0; i < space.size(); ++i)
    said["log_sd"][std::string(name(space.parameters[static_cast<size_t>(i)]))] =
        posterior.log_sd[i];
  for (int i = 0; i < 3; ++i) said["rigidity_log_sd"].push_back(posterior.rigidity_log_sd[i]);
  if (!posterior.covariance.allFinite()) return said;
  const Eigen::SelfAdjointEigenSolver<MatX> modes(posterior.covariance);  // best seen first
  for (int k = 0; k < space.size(); ++k) {
    said["singular_values"].push_back(1 / std::sqrt(modes.eigenvalues()[k]));
    const VecX direction = modes.eigenvectors().col(k);
    said["directions"].push_back(std::vector<double>(direction.begin(), direction.end()));
  }
  return said;
}

Json study(const Settings& settings, const std::vector<std::pair<double, SpecimenModel>>& models,
           int index) {
  Random random(seed_of_item(settings.experiment.seed, static_cast<std::uint64_t>(index)));
  const Fabric fabric = random_fabric(random, FabricDistribution::measured);
  const ParameterSpace space{settings.estimate.parameters, fabric};
  Json item = {{"fabric", index}};
  for (const Parameter p : all_parameters()) item["parameters"][std::string(name(p))] = fabric[p];
  try {
    for (const ExperimentDesign& design : designs()) {
      std::vector<SeenDrape> drapes;
      for (const Specimen& specimen : design.specimens)
        for (const auto& [radius, model] : models)
          if (radius == specimen.radius)
            drapes.push_back(see(settings, model, fabric, specimen.turned, space));
      if (!item.contains("drape_coefficient_percent")) {
        const SeenDrape& first = drapes.front();
        const Outline outline = trace_outline(first.picture.model.mesh(), first.picture.scene,
                                              first.point.equilibrium.x);
        item["drape_coefficient_percent"] =
            100 * drape_coefficient(first.picture.scene, area(outline.points));
        item["node_count"] = node_count(first.picture.seen.profile);
      }
      item["designs"][design.name] = information(space, drapes);
    }
    item["status"] = "converged";
  } catch (const std::runtime_error& error) {  // a drape or its outline failed: no result here
    item["status"] = error.what();
  }
  return item;
}

}  // namespace

RunOutcome run_identifiability(const Settings& settings, OutputFolder& folder) {
  const int count = settings.identifiability.fabrics;
  const auto models = specimen_models(settings);
  const JsonStore store(folder, "fabrics");
  const auto item_name = [](int i) { return std::to_string(i); };
  std::vector<int> missing;
  for (int i = 0; i < count; ++i)
    if (!store.has(item_name(i))) missing.push_back(i);
  {
    const int left = static_cast<int>(missing.size());
    Progress progress("identifiability", count, count - left);
    for_each_item(left, settings.experiment.thread_count(), [&](int m) {
      const int i = missing[static_cast<size_t>(m)];
      const Json item = study(settings, models, i);
      store.save(item_name(i), item);
      if (item["status"] != "converged")
        progress.note("fabric " + item_name(i) + ": " + item["status"].get<std::string>());
      progress.advance();
    });
  }
  if (interrupted()) return {"partial", {}};

  RunOutcome outcome;
  Json& summary = outcome.summary;
  summary["fabrics"] = count;
  for (const Parameter p : settings.estimate.parameters) summary["parameters"].push_back(name(p));
  int good = 0;
  std::map<std::string, std::map<std::string, std::vector<double>>> log_sd;
  for (int i = 0; i < count; ++i) {
    const Json item = store.load(item_name(i));
    summary["items"].push_back(item);
    if (item["status"] != "converged") continue;
    ++good;
    for (const auto& [design, said] : item["designs"].items())
      for (const auto& [parameter, value] : said["log_sd"].items())
        log_sd[design][parameter].push_back(number(value));
  }
  summary["solved"] = good;
  std::printf("%-30s", "median sd of the logarithm of");
  for (const Parameter p : settings.estimate.parameters)
    std::printf(" %9s", std::string(name(p)).c_str());
  std::printf("\n");
  for (const ExperimentDesign& design : designs()) {
    std::printf("%-30s", design.name);
    for (const Parameter p : settings.estimate.parameters) {
      const double value = median(log_sd[design.name][std::string(name(p))]);
      summary["log_sd_median"][design.name][std::string(name(p))] = value;
      std::printf(" %9.3g", value);
    }
    std::printf("\n");
  }
  outcome.status = good == count ? "ok" : good > 0 ? "partial" : "failed";
  write_text_durably(folder / "identifiability.json", summary_text(summary));
  draw_figure("identifiability.py", folder / "identifiability.json", folder / "identifiability");
  return outcome;
}

}  // namespace drape
