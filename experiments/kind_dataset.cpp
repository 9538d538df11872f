// kind = "dataset": the drapes of fabrics of the tag model or of a table, in parallel over fabrics.
#include <exception>
#include <string>
#include <vector>

#include "core/cpu_clock.h"
#include "core/sha256.h"
#include "experiments/dataset_fabrics.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/record_store.h"
#include "experiments/replay.h"
#include "experiments/statistics.h"

namespace drape {
namespace {

/// The drape of a fabric; whatever goes wrong becomes the record's status.
Record drape_record(const Settings& settings, std::shared_ptr<const Discretization> discretization,
                    const Fabric& fabric) {
  try {
    Potential potential = make_potential(discretization, fabric, settings);
    const ContactDrape draped = drape(settings, potential);
    return make_record(settings, potential, draped.equilibrium);
  } catch (const std::exception& error) {
    return failed_record(settings, discretization->mesh(), fabric, error.what());
  }
}

/// What the summary says of a fabric without a drape.
nlohmann::ordered_json failure(const DatasetFabrics& fabrics, int index, const Record& record,
                               const std::filesystem::path& run) {
  const std::string number = std::to_string(index);
  return {{"index", index},
          {"id", record.id},
          {"seed", fabrics.seed(index)},
          {"status", record.stats.status},
          {"replay", replay_command(run, "replay_" + number, {"dataset.only=[" + number + "]"})}};
}

}  // namespace

RunOutcome drape_dataset(const Settings& settings, OutputFolder& folder) {
  const DatasetFabrics fabrics(settings);
  const std::vector<int> chosen = fabrics.chosen();
  const int count = static_cast<int>(chosen.size());
  const auto discretization = make_discretization(settings);
  const RecordStore store(folder.path(), records_header(settings, discretization->mesh()), count);
  const int resumed = store.finished();
  const double start = process_cpu_seconds();
  {
    Progress progress("dataset", count, resumed);
    for_each_item(count, settings.experiment.thread_count(), [&](int i) {
      if (store.has(i)) return;
      const Record tag = fabrics[chosen[static_cast<size_t>(i)]];
      Record record = drape_record(settings, discretization, tag.fabric);
      record.id = tag.id;
      record.name = tag.name;
      record.category = tag.category;
      record.subcategory = tag.subcategory;
      record.type = tag.type;
      record.composition = tag.composition;
      store.save(i, record);
      if (!converged(record)) progress.note("fabric " + tag.id + ": " + record.stats.status);
      progress.advance();
    });
  }
  const double cpu = process_cpu_seconds() - start;
  if (interrupted()) return {"partial", {}};

  store.consolidate();
  const std::filesystem::path table = folder / "results.h5";
  write_checksum(table);
  int certified = 0, on_support = 0, self_intersecting = 0, visited = 0;
  std::vector<double> cpu_seconds;
  auto failures = nlohmann::ordered_json::array();
  store.visit([&](const Record& record) {
    const int index = chosen[static_cast<size_t>(visited++)];
    if (!converged(record)) failures.push_back(failure(fabrics, index, record, folder.path()));
    certified += converged(record) && record.stats.negative_eigenvalues == 0;
    on_support += record.stats.contact == "support";
    self_intersecting += record.stats.self_intersections > 0;
    cpu_seconds.push_back(record.stats.cpu_seconds);
  });
  const int failed = static_cast<int>(failures.size());
  const int generated = count - resumed;
  RunOutcome outcome{failed == 0 ? "ok" : failed < count ? "partial" : "failed", {}};
  outcome.summary["fabrics_of_all_shards"] = fabrics.count();
  outcome.summary["requested"] = count;
  outcome.summary["generated"] = generated;
  outcome.summary["resumed"] = resumed;
  outcome.summary["failed"] = failed;
  outcome.summary["certified_minima"] = certified;
  outcome.summary["contact_with_support"] = on_support;
  outcome.summary["self_intersecting"] = self_intersecting;
  outcome.summary["vertices"] = discretization->mesh().vertex_count();
  outcome.summary["file_bytes"] = std::filesystem::file_size(table);
  outcome.summary["drape_cpu_seconds_percentiles"] = percentiles(cpu_seconds);
  outcome.summary["drapes_per_cpu_second"] =
      generated > 0 ? nlohmann::ordered_json(generated / cpu) : nullptr;
  outcome.summary["failures"] = failures;
  return outcome;
}

RunOutcome run_dataset(const Settings& settings, OutputFolder& folder) {
  RunOutcome outcome = drape_dataset(settings, folder);
  if (!interrupted() && settings.dataset.shards == 1)
    draw_figure("dataset.py", folder / "results.h5", folder / "dataset");
  return outcome;
}

}  // namespace drape
