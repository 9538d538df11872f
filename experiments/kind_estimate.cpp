// kind = "estimate": parameters back from outlines, over the records of a dataset or random
// fabrics.
#include <exception>
#include <iostream>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "core/coarse_level.h"
#include "core/random.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/record_store.h"
#include "experiments/recovery.h"
#include "experiments/recovery_report.h"
#include "experiments/recovery_targets.h"

namespace drape {
namespace {

/// The targets: fabrics with their drapes, and the header that they share.
struct Targets {
  RecordsHeader header;
  std::shared_ptr<const Discretization> discretization;
  std::vector<Record> records;  // empty but for the id where random fabrics are not drawn yet
  std::optional<RandomTargets> random;
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
  targets.discretization = with_coarse_level(
      make_mesh(stored.rest_uv, stored.triangles, stored.fixed, stored.clamp_wing_factor),
      stored.scene, {.clamp_wing_factor = stored.clamp_wing_factor}, settings.solver.factorization);
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
  targets.random.emplace(settings, targets.discretization);
  targets.records.resize(static_cast<size_t>(settings.estimate.fabrics));
  for (size_t i = 0; i < targets.records.size(); ++i) targets.records[i].id = std::to_string(i);
  return targets;
}

Record finished(const Settings& settings, const Targets& targets, const TagPrior& tag_prior,
                Record record, int index) {
  if (record.positions.size() == 0) record = (*targets.random)[index];
  const Potential model(targets.discretization, record.fabric, targets.header.reading,
                        targets.header.scene.gravity);
  const std::uint64_t seed =
      seed_of_item(settings.experiment.seed, static_cast<std::uint64_t>(index));
  if (converged(record))
    record.estimate = recover(settings, model, record, targets.header, tag_prior, seed);
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

}  // namespace

RunOutcome run_estimate(const Settings& settings, OutputFolder& folder) {
  const Targets targets =
      settings.estimate.dataset.empty() ? random_targets(settings) : read_targets(settings);
  const TagPrior tag_says = tag_prior(settings.estimate, targets.header.reading.threshold);
  const int count = static_cast<int>(targets.records.size());
  const RecordStore store(folder.path(), targets.header, count);
  {
    Progress progress("estimate", count, store.finished());
    for_each_item(count, settings.experiment.thread_count(), [&](int i) {
      if (store.has(i)) return;
      const Record& target = targets.records[static_cast<size_t>(i)];
      Record record;
      try {
        record = finished(settings, targets, tag_says, target, i);
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
  draw_figure("recovery.py", folder / "results.h5", folder / "recovery");
  nlohmann::ordered_json summary = recovery_summary(settings.estimate, store.load_all());
  const int succeeded = summary["succeeded"];
  std::cout << summary["recovered"] << " of " << count
            << " recovered (bending within 2 %, shear within 10 %)\n";
  return {succeeded == count ? "ok" : succeeded > 0 ? "partial" : "failed", std::move(summary)};
}

}  // namespace drape
