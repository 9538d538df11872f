// kind = "photograph": parameters from the photograph of one drape.
#include <cmath>
#include <filesystem>
#include <iostream>

#include "estimation/bending_rigidity.h"
#include "estimation/photograph.h"
#include "estimation/tag.h"
#include "experiments/figure.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/record_store.h"
#include "experiments/recovery.h"

namespace drape {
namespace {

/// The photograph as a record: an observation of a fabric of which little is known.
Record observed_record(const Settings& settings, const Photograph& photograph, const Mesh& mesh,
                       const Fabric& first) {
  Record record = failed_record(settings, mesh, first, "not solved: the fabric is unknown");
  record.id = record.name = settings.photograph.file.stem().string();
  record.observation.profile = photograph.profile;
  record.observation.coverage = photograph.coverage;
  record.observation.drape_coefficient = drape_coefficient(settings.scene, photograph.area);
  record.observation.node_count = node_count(photograph.profile);
  return record;
}

nlohmann::ordered_json summarise(const Settings& settings, const Record& record,
                                 const Estimate& result) {
  const EstimateRecord& e = *record.estimate;
  nlohmann::ordered_json summary;
  summary["file"] = settings.photograph.file.filename().string();
  summary["outcome"] = e.outcome;
  summary["guide_released"] = result.kappa == 0;
  summary["certified_minimum"] = result.equilibrium.converged();
  summary["residual_relative"] = e.stats.residual_relative;
  summary["negative_eigenvalues"] = e.stats.negative_eigenvalues;
  summary["outline_rms_mm"] = 1e3 * e.outline_rms;
  summary["iou"] = e.iou;
  summary["node_count"] = e.node_count;
  summary["node_count_photograph"] = record.observation.node_count;
  summary["drape_coefficient_percent"] = 100 * e.drape_coefficient;
  summary["drape_coefficient_percent_photograph"] = 100 * record.observation.drape_coefficient;
  for (Parameter p : all_parameters()) summary["parameters"][std::string(name(p))] = e.fabric[p];
  for (Parameter p : settings.estimate.parameters)
    summary["log_sd"][std::string(name(p))] = e.log_sd[static_cast<int>(p)];
  const Vec3 B = effective_rigidity(e.fabric);
  summary["effective_rigidity"] = {{"B_u", B[0]}, {"B_v", B[1]}, {"B_45", B[2]}};
  summary["centre_mm"] = {1e3 * result.centre.x(), 1e3 * result.centre.y()};
  summary["contact"] = result.contact.acting();
  summary["contact_reason"] = result.contact.reason;
  summary["contact_doubtful"] = result.contact_doubtful;
  summary["iterations"] = result.iterations;
  summary["forward_solves"] = e.forward_solves;
  summary["fit_cpu_seconds"] = result.cpu_seconds;
  return summary;
}

}  // namespace

RunOutcome run_photograph(const Settings& settings, OutputFolder& folder) {
  const Photograph photograph = read_photograph(
      settings.photograph.file, 1e-3 * settings.photograph.mm_per_pixel, settings.scene);
  const Fabric first =
      first_parameters(settings.photograph.structure, settings.photograph.areal_density);

  const auto discretization = make_discretization(settings);
  const Potential model = make_potential(discretization, first, settings);
  OutlineObservation observation;
  observation.profile = photograph.profile;
  observation.noise = settings.photograph.outline_noise;
  observation.centre_known = false;
  observation.grid = photograph.grid;
  observation.coverage = photograph.coverage;
  EstimateOptions options = estimate_options(settings);
  options.prior_log_sd = settings.photograph.prior_log_sd;
  const Estimate result = estimate(model, settings.scene, observation, first, options);

  Record record = observed_record(settings, photograph, discretization->mesh(), first);
  record.estimate = estimate_record(model, settings.scene, result, observation, options.parameters);
  RecordsHeader header = records_header(settings, discretization->mesh());
  header.grid = photograph.grid;
  const RecordStore store(folder.path(), header, 1);
  store.save(0, record);
  store.consolidate();
  draw_figure("estimate_overlay.py", folder / "results.h5", folder / "overlay");

  nlohmann::ordered_json summary = summarise(settings, record, result);
  std::cout << "Fit of " << summary["file"].get<std::string>() << ": " << record.estimate->outcome
            << ", outline rms " << 1e3 * record.estimate->outline_rms << " mm, IoU "
            << record.estimate->iou << ", nodes " << record.estimate->node_count << " (photograph "
            << record.observation.node_count << ")\n";
  return {result.outcome == EstimateOutcome::succeeded ? "ok" : "failed", std::move(summary)};
}

}  // namespace drape
