// kind = "photograph": parameters from photographs of the drapes of one fabric.
#include <cmath>
#include <filesystem>
#include <iostream>

#include "estimation/tag.h"
#include "experiments/figure.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/photograph_fit.h"
#include "experiments/record_store.h"
#include "experiments/recovery.h"
#include "experiments/statistics.h"

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

Json picture_summary(const std::filesystem::path& file, const Record& record,
                     const PictureEstimate& drape) {
  const EstimateRecord& e = *record.estimate;
  Json summary;
  summary["file"] = file.filename().string();
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

}  // namespace

RunOutcome run_photograph(const Settings& settings, OutputFolder& folder) {
  const PhotographSettings& given = settings.photograph;
  std::vector<Photograph> photographs;
  for (const std::filesystem::path& file : given.files)
    photographs.push_back(read_photograph(file, 1e-3 * given.mm_per_pixel, settings.scene));
  const Fabric first = first_parameters(given.structure, given.areal_density);

  const auto discretization = make_discretization(settings);
  const Potential model = make_potential(discretization, first, settings);
  EstimateOptions options = estimate_options(settings);
  options.prior = fit_prior(settings, given.prior, given.structure, first);
  const WarpSearch search = fit_photographs(settings, model, first, photographs, options);
  const Estimate& result = search.best;

  const int count = static_cast<int>(photographs.size());
  const RecordStore store(folder.path(), records_header(settings, discretization->mesh()), count);
  Json each = Json::array();
  std::vector<double> squared_rms, iou;
  Record record;
  for (size_t i = 0; i < photographs.size(); ++i) {
    record =
        observed_record(settings, given.files[i], photographs[i], discretization->mesh(), first);
    record.estimate =
        estimate_record(search.pictures[i], result.pictures[i], result, options.parameters);
    store.save(static_cast<int>(i), record);
    each.push_back(picture_summary(given.files[i], record, result.pictures[i]));
    squared_rms.push_back(std::pow(1e3 * record.estimate->outline_rms, 2));
    iou.push_back(record.estimate->iou);
  }
  store.consolidate();
  draw_figure("estimate_overlay.py", folder / "results.h5", folder / "overlay");

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
