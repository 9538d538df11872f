// kind = "estimate": parameters back from outlines, over the records of a dataset or random
// fabrics.
#include <cmath>
#include <exception>
#include <iostream>
#include <numeric>
#include <stdexcept>

#include "core/random.h"
#include "experiments/interrupt.h"
#include "experiments/interval_coverage.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/random_fabric.h"
#include "experiments/record_store.h"
#include "experiments/recovery.h"
#include "experiments/statistics.h"

namespace drape {
namespace {

constexpr double kIdentifiable =
    0.2;  // log standard deviation below which a parameter counts as seen
constexpr double kBendingError = 0.02, kShearError = 0.10;  // what counts as recovered

/// The targets: fabrics with their drapes, and the header that they share.
struct Targets {
  RecordsHeader header;
  std::shared_ptr<const Discretization> discretization;
  std::vector<Record> records;  // without positions for random fabrics not draped yet
};

std::vector<int> chosen_records(const Settings& settings, int available) {
  std::vector<int> chosen = settings.estimate.records;
  if (chosen.empty()) {
    chosen.resize(static_cast<size_t>(available));
    std::iota(chosen.begin(), chosen.end(), 0);
  }
  for (int index : chosen)
    if (index >= available)
      throw std::invalid_argument("estimate.records names record " + std::to_string(index) + "; " +
                                  settings.estimate.dataset.string() + " has " +
                                  std::to_string(available) + " (0 to " +
                                  std::to_string(available - 1) + ")");
  return chosen;
}

Targets read_targets(const Settings& settings) {
  Targets targets;
  const RecordsHeader stored = read_header(settings.estimate.dataset);
  std::vector<Record> all = read_records(settings.estimate.dataset);
  for (int index : chosen_records(settings, static_cast<int>(all.size())))
    targets.records.push_back(all[static_cast<size_t>(index)]);
  targets.discretization = std::make_shared<const Discretization>(
      make_mesh(stored.rest_uv, stored.triangles, stored.fixed, stored.clamp_wing_factor),
      settings.solver.factorization);
  targets.header = records_header(settings, targets.discretization->mesh());
  targets.header.scene = stored.scene;
  targets.header.reading = stored.reading;
  targets.header.grid = stored.grid;
  return targets;
}

Targets random_targets(const Settings& settings) {
  Targets targets;
  targets.discretization = make_discretization(settings);
  targets.header = records_header(settings, targets.discretization->mesh());
  for (int i = 0; i < settings.estimate.fabrics; ++i) {
    Random random(seed_of_item(settings.experiment.seed, static_cast<std::uint64_t>(i)));
    Record record;
    record.id = record.name = std::to_string(i);
    record.fabric = random_fabric(random);
    targets.records.push_back(record);
  }
  return targets;
}

Record finished(const Settings& settings, const Targets& targets, Record record,
                std::uint64_t seed) {
  Potential model(targets.discretization, record.fabric, targets.header.reading,
                  targets.header.scene.gravity);
  if (record.positions.size() == 0) {
    const Record tag = record;
    const Equilibrium target = drape(settings, model).equilibrium;
    record = make_record(settings, model, target);
    record.id = tag.id;
    record.name = tag.name;
  }
  if (converged(record)) record.estimate = recover(settings, model, record, targets.header, seed);
  return record;
}

/// What cannot be estimated is kept as such.
Record failed_estimate(const Record& target, const std::string& reason) {
  Record record = target;
  EstimateRecord estimate;
  estimate.fabric = estimate.start = target.fabric;
  estimate.outcome = reason;
  estimate.log_sd = ParameterVector::Constant(std::nan(""));
  estimate.positions = VecX::Constant(target.positions.size(), std::nan(""));
  estimate.profile = estimate.start_profile = VecX::Constant(kProfileSize, std::nan(""));
  estimate.stats.status = reason;
  record.estimate = estimate;
  return record;
}

bool recovered(const Record& record, const std::vector<Parameter>& parameters) {
  for (Parameter p : parameters) {
    const double error = std::abs(record.estimate->fabric[p] / record.fabric[p] - 1);
    if (!(error <= (p == Parameter::k_h ? kShearError : kBendingError))) return false;
  }
  return record.estimate->outcome == name(EstimateOutcome::succeeded);
}

nlohmann::ordered_json summarise(const Settings& settings, const std::vector<Record>& records) {
  std::vector<double> rms, dc_error, iou, solves, cpu;
  int succeeded = 0, shared = 0, recovered_count = 0, shared_recovered = 0;
  std::vector<std::vector<double>> error(settings.estimate.parameters.size());
  std::vector<int> identifiable(settings.estimate.parameters.size(), 0);
  for (const Record& record : records) {
    if (!record.estimate) continue;
    const EstimateRecord& e = *record.estimate;
    const bool is_recovered = recovered(record, settings.estimate.parameters);
    shared += e.branch_shared;
    recovered_count += is_recovered;
    shared_recovered += e.branch_shared && is_recovered;
    solves.push_back(e.forward_solves);
    cpu.push_back(e.stats.cpu_seconds);
    if (e.outcome != name(EstimateOutcome::succeeded)) continue;
    ++succeeded;
    rms.push_back(1e3 * e.outline_rms);
    dc_error.push_back(std::abs(e.drape_coefficient - record.observation.drape_coefficient));
    iou.push_back(e.iou);
    for (size_t i = 0; i < error.size(); ++i) {
      const Parameter p = settings.estimate.parameters[i];
      error[i].push_back(std::abs(e.fabric[p] / record.fabric[p] - 1));
      identifiable[i] += e.log_sd[static_cast<int>(p)] < kIdentifiable;
    }
  }
  nlohmann::ordered_json summary;
  summary["fabrics"] = records.size();
  summary["succeeded"] = succeeded;
  summary["branches_shared"] = shared;
  summary["recovered"] = recovered_count;
  summary["recovered_of_shared"] = shared_recovered;
  for (size_t i = 0; i < error.size(); ++i) {
    const std::string parameter(name(settings.estimate.parameters[i]));
    summary["median_parameter_error"][parameter] = median(error[i]);
    summary["identifiable"][parameter] = succeeded > 0 ? 1.0 * identifiable[i] / succeeded : 0.0;
  }
  summary["coverage_68"] = interval_coverage(records, settings.estimate.parameters, k68);
  summary["coverage_95"] = interval_coverage(records, settings.estimate.parameters, k95);
  summary["median_outline_rms_mm"] = median(rms);
  summary["median_drape_coefficient_error"] = median(dc_error);
  summary["iou_median"] = median(iou);
  summary["forward_solves_median"] = median(solves);
  summary["cpu_seconds_median"] = median(cpu);
  return summary;
}

}  // namespace

RunOutcome run_estimate(const Settings& settings, OutputFolder& folder) {
  const Targets targets =
      settings.estimate.dataset.empty() ? random_targets(settings) : read_targets(settings);
  const int count = static_cast<int>(targets.records.size());
  const RecordStore store(folder.path(), targets.header, count);
  {
    Progress progress("estimate", count, store.finished());
    for_each_item(count, settings.experiment.thread_count(), [&](int i) {
      if (store.has(i)) return;
      const Record& target = targets.records[static_cast<size_t>(i)];
      Record record;
      try {
        record = finished(settings, targets, target,
                          seed_of_item(settings.experiment.seed, static_cast<std::uint64_t>(i)));
      } catch (const std::exception& error) {
        record = target.positions.size() == 0
                     ? failed_record(settings, targets.discretization->mesh(), target.fabric,
                                     error.what())
                     : failed_estimate(target, error.what());
      }
      store.save(i, record);
      if (!record.estimate)
        progress.note("fabric " + target.id + ": no drape, " + record.stats.status);
      else if (record.estimate->outcome != name(EstimateOutcome::succeeded))
        progress.note("fabric " + target.id + ": " + record.estimate->outcome);
      progress.advance();
    });
  }
  if (interrupted()) return {"partial", {}};
  store.consolidate();
  nlohmann::ordered_json summary = summarise(settings, store.load_all());
  const int succeeded = summary["succeeded"];
  std::cout << summary["branches_shared"] << " of " << count
            << " targets share a branch with their start; recovered (bending within 2 %, shear "
               "within 10 %): "
            << summary["recovered_of_shared"] << " of these, " << summary["recovered"]
            << " of all\n";
  return {succeeded == count ? "ok" : succeeded > 0 ? "partial" : "failed", std::move(summary)};
}

}  // namespace drape
