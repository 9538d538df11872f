#include "experiments/config_checks.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/ensemble.h"

namespace drape {
namespace {

// Specimens and camera of kind = "photograph".
void check_photograph(const Settings& settings, const Refuse& refuse) {
  const std::vector<double>& radii = settings.photograph.specimen_radius_mm;
  const size_t files = settings.photograph.files.size();
  if (radii.size() > 1 && radii.size() != files)
    refuse("photograph.specimen_radius_mm",
           "photograph.specimen_radius_mm holds " + std::to_string(radii.size()) + " radii for " +
               std::to_string(files) + " files; give one for each, or one for all");
  for (const double radius : radii) {
    Scene scene = settings.scene;
    scene.specimen_radius = 1e-3 * radius;
    try {
      validate(scene);
    } catch (const std::invalid_argument& error) {
      refuse("photograph.specimen_radius_mm", error.what());
    }
  }
  const double height = settings.photograph.camera_height_mm;
  const double largest = radii.empty() ? 1e3 * settings.scene.specimen_radius
                                       : *std::max_element(radii.begin(), radii.end());
  if (height > 0 && height <= largest)
    refuse("photograph.camera_height_mm",
           "photograph.camera_height_mm is below the radius of the specimen; it counts from the "
           "support up, in millimetres");
}

// No cloth weighs more: beyond, a density is in g/m^2 by mistake.
constexpr double kHeaviest = 5;  // [kg/m^2]

void check_densities(const Settings& settings, const Refuse& refuse) {
  const auto check = [&](const std::string& key, double density) {
    if (!(density > kHeaviest)) return;
    std::ostringstream message;
    message << key << " = " << density << " kg/m^2: no cloth is that heavy; if it is in g/m^2, "
            << "write " << density / 1000;
    refuse(key, message.str());
  };
  check("fabric.areal_density", settings.fabric.areal_density);
  check("photograph.areal_density", settings.photograph.areal_density);
  check("photographs.areal_density", settings.photographs.areal_density);
  for (const double density : settings.photographs.densities)
    check("photographs.densities", density);
  check("quickstart.areal_density", settings.quickstart.areal_density);
}

/// Not every build has CHOLMOD.
void check_factorization(const Settings& settings, const Refuse& refuse) {
  try {
    factor_backend_from_name(name(settings.solver.factorization));
  } catch (const std::invalid_argument& error) {
    refuse("solver.factorization", error.what());
  }
}

}  // namespace

void check_fit(const Settings& settings, const Refuse& refuse) {
  const Kind kind = settings.experiment.kind;
  check_factorization(settings, refuse);
  check_densities(settings, refuse);
  if (kind == Kind::photograph) {
    if (settings.photograph.files.empty())
      refuse("experiment.kind", "a photograph needs photograph.files");
    if (!(settings.photograph.mm_per_pixel > 0))
      refuse("photograph.mm_per_pixel", "a photograph needs photograph.mm_per_pixel > 0");
    if (!(settings.photograph.areal_density > 0))
      refuse("photograph.areal_density", "a photograph needs photograph.areal_density > 0 kg/m^2");
    check_photograph(settings, refuse);
  }
  if (kind == Kind::photograph_set && settings.photograph_set.manifest.empty())
    refuse("experiment.kind", "a set of photographs needs photograph_set.manifest");
  if (kind == Kind::photographs && settings.photographs.folder.empty())
    refuse("experiment.kind", "photographs need photographs.folder");
  if (!settings.photographs.folder.empty()) {
    if (!(settings.photograph.mm_per_pixel > 0))
      refuse("photograph.mm_per_pixel", "photographs need photograph.mm_per_pixel > 0");
    if (settings.photographs.models.empty())
      refuse("photographs.models", "photographs.models must name a model");
    if (settings.photographs.weighed.size() != settings.photographs.densities.size())
      refuse("photographs.densities",
             "photographs.densities must hold one density for each of "
             "photographs.weighed");
  }
  if (kind == Kind::ablation && !settings.photographs.folder.empty() &&
      settings.photograph.camera_height_mm > 0)
    refuse("photograph.camera_height_mm",
           "an ablation holds drapes against photographs.folder in orthographic views only");
  if (settings.dataset.shard > settings.dataset.shards)
    refuse("dataset.shard", "dataset.shard must be 1 to dataset.shards");
  if (!settings.dataset.table.empty() && !settings.dataset.parameters.empty())
    refuse("dataset.parameters", "dataset.table and dataset.parameters exclude each other");
  if (!settings.dataset.radii.empty() && kind != Kind::dataset)
    refuse("dataset.radii",
           "dataset.radii is only for kind \"dataset\"; set scene.specimen_radius");
  for (const double radius : settings.dataset.radii)
    if (!(radius > settings.scene.support_radius))
      refuse("dataset.radii", "dataset.radii must be larger than scene.support_radius");
  for (const StartProtocol protocol : settings.dataset.protocols)
    if (protocol == StartProtocol::guided)
      refuse("dataset.protocols",
             "dataset.protocols cannot hold \"guided\", which follows one outline");
  if (settings.photograph.type.empty() != settings.photograph.composition.empty())
    refuse("photograph.type", "a tag has photograph.type and photograph.composition; give both");
  if (settings.photograph.prior == PriorKind::tag && settings.photograph.type.empty())
    refuse("photograph.prior",
           "photograph.prior = \"tag\" needs photograph.type and photograph.composition");
  const bool of_tags = settings.estimate.prior == PriorKind::tag ||
                       settings.estimate.first == FirstParameters::tag ||
                       settings.photograph.prior == PriorKind::tag || kind == Kind::photograph_set;
  if (!settings.estimate.tag_dataset.empty() && !of_tags)
    refuse("estimate.tag_dataset",
           "estimate.tag_dataset is only for estimate.prior, estimate.first or photograph.prior = "
           "\"tag\"");
  if (kind == Kind::paper && settings.paper.configs.empty())
    refuse("experiment.kind", "a paper needs paper.configs, the experiments to collect");
  if (kind == Kind::quickstart && settings.quickstart.table.empty())
    refuse("experiment.kind", "the quickstart needs quickstart.table");
  if (settings.start.protocol == StartProtocol::guided &&
      settings.start.outline.empty() == settings.start.dataset.empty())
    refuse("start.protocol",
           "a guided start needs either start.outline or start.dataset, and not both");
  if (settings.start.protocol == StartProtocol::ensemble) try {
      ensemble_starts(settings.start.ensemble);
    } catch (const std::invalid_argument& error) {
      refuse("start.protocol", error.what());
    }
  if (!settings.mesh.vertices && kind != Kind::drape)
    refuse("mesh.vertices",
           "mesh.vertices = \"auto\" is only for kind \"drape\"; this kind of experiment needs a "
           "count, as "
           "all that it compares is on one mesh");
  if (!settings.mesh.vertices && settings.start.protocol == StartProtocol::ensemble)
    refuse("mesh.vertices",
           "mesh.vertices = \"auto\" follows one drape; an ensemble needs a count");
  if (kind == Kind::drape && settings.start.settled &&
      settings.start.protocol == StartProtocol::ensemble)
    refuse(
        "start.settled",
        "start.settled is for one drape; kind \"drape\" lists every minimum of an ensemble as it "
        "is");
  if (kind == Kind::branches && !(settings.branches.softest < settings.branches.stiffest))
    refuse("branches.softest", "branches.softest must be less than branches.stiffest");
  for (const auto& [key, range] :
       {std::pair{"estimate.drape_coefficient", settings.estimate.drape_coefficient},
        {"estimate.anisotropy", settings.estimate.anisotropy}})
    if (range.size() != 2 || !(range[0] < range[1]))
      refuse(key, std::string(key) + " must be two values, from less than to");
  const bool only_forward = kind == Kind::drape || kind == Kind::dataset ||
                            kind == Kind::robustness || kind == Kind::validation ||
                            kind == Kind::accuracy || kind == Kind::work_precision ||
                            kind == Kind::stability;
  if (settings.reading.law == BendingLaw::secant && !only_forward)
    refuse("fabric.bending_law",
           "the secant law has no derivative; this kind of experiment needs \"tangent\"");
}

}  // namespace drape
