// kind = "photograph": parameters from photographs of the drapes of one fabric.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>

#include "estimation/tag.h"
#include "experiments/dataset_fabrics.h"
#include "experiments/figure.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/photograph_fit.h"
#include "experiments/record_store.h"
#include "experiments/recovery.h"
#include "experiments/statistics.h"
#include "experiments/tag_dataset.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

/// The photograph as a record: an observation of a fabric of which little is known.
Record observed_record(const Settings& settings, const std::filesystem::path& file,
                       const Photograph& photograph, const Mesh& mesh, const Fabric& first) {
  Record record = failed_record(settings, mesh, first, "not solved: the fabric is unknown");
  record.id = record.name = file.stem().string();
  record.observation.profile = photograph.profile;
  record.observation.coverage = coverage(photograph.outline, observation_grid(settings));
  record.observation.drape_coefficient = drape_coefficient(settings.scene, photograph.area);
  record.observation.node_count = node_count(photograph.profile);
  return record;
}

Json picture_summary(const std::filesystem::path& file, double specimen_radius,
                     const Record& record, const PictureEstimate& drape) {
  const EstimateRecord& e = *record.estimate;
  Json summary;
  summary["file"] = file.filename().string();
  summary["specimen_radius"] = specimen_radius;
  summary["outline_rms_mm"] = 1e3 * e.outline_rms;
  summary["iou"] = e.iou;
  summary["node_count"] = e.node_count;
  summary["node_count_photograph"] = record.observation.node_count;
  summary["drape_coefficient_percent"] = 100 * e.drape_coefficient;
  summary["drape_coefficient_percent_photograph"] = 100 * record.observation.drape_coefficient;
  summary["centre_mm"] = {1e3 * drape.placement.centre.x(), 1e3 * drape.placement.centre.y()};
  summary["warp_angle_deg"] = warp_degrees(drape.placement.weft_angle);
  summary["scale"] = std::exp(drape.placement.log_scale);
  summary["certified_minimum"] = drape.equilibrium.converged();
  summary["residual_relative"] = e.stats.residual_relative;
  summary["negative_eigenvalues"] = e.stats.negative_eigenvalues;
  summary["contact"] = drape.contact.acting();
  summary["contact_reason"] = drape.contact.reason;
  summary["contact_doubtful"] = drape.contact_doubtful;
  return summary;
}

/// What the pictures decided and what the prior: every direction in the space of the logarithms,
/// scaled to one standard deviation of the prior, with the pictures' share of what is known of it.
Json direction_summary(const std::vector<Parameter>& parameters, const Posterior& posterior) {
  Json list = Json::array();
  for (Eigen::Index k = 0; k < posterior.direction_shares.size(); ++k) {
    Json direction;
    direction["picture_share"] = posterior.direction_shares[k];
    for (size_t i = 0; i < parameters.size(); ++i)
      direction["direction"][std::string(name(parameters[i]))] =
          posterior.directions(static_cast<Eigen::Index>(i), k);
    list.push_back(direction);
  }
  return list;
}

Json summarise(const Settings& settings, const WarpSearch& search, const EstimateRecord& e) {
  const Estimate& result = search.best;
  Json summary;
  summary["outcome"] = e.outcome;
  summary["guide_released"] = result.kappa == 0;
  for (Parameter p : all_parameters()) summary["parameters"][std::string(name(p))] = e.fabric[p];
  for (Parameter p : settings.estimate.parameters) {
    summary["log_sd"][std::string(name(p))] = e.log_sd[static_cast<int>(p)];
    summary["picture_share"][std::string(name(p))] = e.picture_share[static_cast<int>(p)];
  }
  const std::array<const char*, 3> directions{"B_u", "B_v", "B_45"};
  for (Eigen::Index i = 0; i < 3; ++i) {
    const char* label = directions[static_cast<size_t>(i)];
    summary["effective_rigidity"][label] = e.rigidity[i];
    summary["effective_rigidity_log_sd"][label] = e.rigidity_log_sd[i];
  }
  summary["directions"] = direction_summary(settings.estimate.parameters, result.posterior);
  for (const WarpTrial& trial : search.trials)
    summary["warp_trials"].push_back({{"picture", trial.picture + 1},
                                      {"warp_angle_deg", warp_degrees(trial.weft_angle)},
                                      {"outcome", name(trial.outcome)},
                                      {"cost", trial.cost},
                                      {"found_warp_angle_deg", warp_degrees(trial.found_angle)},
                                      {"outline_rms_mm", 1e3 * trial.outline_rms}});
  summary["iterations"] = result.iterations;
  summary["forward_solves"] = result.forward_solves;
  summary["fit_cpu_seconds"] = result.cpu_seconds;
  return summary;
}

/// Where the records of the pictures of one specimen size are kept: the run's own folder for the
/// first, one of its name for the others.
std::filesystem::path folder_of(const OutputFolder& folder, double radius, bool first) {
  if (first) return folder.path();
  const std::filesystem::path own =
      folder / ("radius_" + std::to_string(std::lround(1e3 * radius)) + "mm");
  std::filesystem::create_directories(own);
  return own;
}

}  // namespace

RunOutcome run_photograph(const Settings& settings, OutputFolder& folder) {
  const PhotographSettings& given = settings.photograph;
  const std::optional<Tag> tag = tag_of(given);
  const Structure structure = tag ? structure_from_category(tag->category) : given.structure;
  const Fabric first = first_parameters(structure, given.areal_density);
  std::vector<Photograph> photographs;
  std::vector<Picture> pictures;
  std::map<double, std::vector<size_t>> of_radius;
  std::map<double, std::shared_ptr<const Discretization>> discretizations;
  for (size_t i = 0; i < given.files.size(); ++i) {
    const Settings own = with_specimen(settings, i);
    const double radius = own.scene.specimen_radius;
    photographs.push_back(read_photograph(given.files[i], 1e-3 * given.mm_per_pixel, own.scene));
    if (!discretizations.contains(radius)) discretizations[radius] = make_discretization(own);
    pictures.push_back(
        picture_of(own, make_potential(discretizations[radius], first, own), photographs.back()));
    of_radius[radius].push_back(i);
  }
  EstimateOptions options = estimate_options(settings);
  options.prior = given.prior == PriorKind::tag
                      ? tag_prior(settings.estimate, settings.reading.threshold)(options.parameters,
                                                                                 tag.value())
                      : fit_prior(settings, given.prior, structure, first);
  const WarpSearch search = fit_pictures(settings, pictures, first, options);
  const Estimate& result = search.best;

  const size_t count = photographs.size();
  std::vector<Json> each(count);
  std::vector<double> squared_rms(count), iou(count);
  Record record;
  for (const auto& [radius, indices] : of_radius) {
    const Settings own = with_specimen(settings, indices.front());
    const Mesh& mesh = discretizations[radius]->mesh();
    const std::filesystem::path place = folder_of(folder, radius, indices.front() == 0);
    const RecordStore store(place, records_header(own, mesh), static_cast<int>(indices.size()));
    for (size_t k = 0; k < indices.size(); ++k) {
      const size_t i = indices[k];
      record = observed_record(own, given.files[i], photographs[i], mesh, first);
      if (tag) copy_tag(tagged(*tag, first), record);
      record.name = record.id;
      record.estimate =
          estimate_record(search.pictures[i], result.pictures[i], result, options.parameters);
      store.save(static_cast<int>(k), record);
      each[i] = picture_summary(given.files[i], radius, record, result.pictures[i]);
      squared_rms[i] = std::pow(1e3 * record.estimate->outline_rms, 2);
      iou[i] = record.estimate->iou;
    }
    store.consolidate();
    draw_figure("estimate_overlay.py", place / "results.h5", place / "overlay");
  }

  Json summary = summarise(settings, search, *record.estimate);
  summary["outline_rms_mm"] = std::sqrt(mean(squared_rms));
  summary["iou"] = mean(iou);
  summary["pictures"] = each;
  std::cout << "Fit of " << count << (count == 1 ? " picture: " : " pictures: ")
            << record.estimate->outcome << ", outline rms "
            << summary["outline_rms_mm"].get<double>() << " mm, IoU "
            << summary["iou"].get<double>() << "\n";
  return {result.outcome == EstimateOutcome::succeeded ? "ok" : "failed", std::move(summary)};
}

}  // namespace drape
