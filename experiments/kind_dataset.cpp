// kind = "dataset": the drapes of fabrics of the tag model or of a table, in parallel over fabrics.
//
// A table has one mesh, so specimens of several radii make a table each: the first is the run's
// own, the others are runs in subfolders. Several start protocols are several records a fabric.
#include <algorithm>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "core/cpu_clock.h"
#include "core/sha256.h"
#include "estimation/csv_table.h"
#include "experiments/config_names.h"
#include "experiments/dataset_fabrics.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/record_store.h"
#include "experiments/replay.h"
#include "experiments/run_part.h"
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

/// One drape of a table: a fabric and the settings whose protocol drapes it.
struct Item {
  int fabric;
  const Settings& settings;
};

/// The drapes of a table: fabric by fabric, each by all protocols.
class Items {
 public:
  Items(const Settings& settings, std::vector<int> fabrics) : fabrics_(std::move(fabrics)) {
    const std::vector<StartProtocol>& protocols = settings.dataset.protocols;
    by_protocol_.assign(std::max<size_t>(1, protocols.size()), settings);
    for (size_t p = 0; p < protocols.size(); ++p) by_protocol_[p].start.protocol = protocols[p];
  }

  int count() const { return static_cast<int>(fabrics_.size() * by_protocol_.size()); }
  Item operator[](int item) const {
    const auto i = static_cast<size_t>(item);
    return {fabrics_[i / by_protocol_.size()], by_protocol_[i % by_protocol_.size()]};
  }

 private:
  std::vector<int> fabrics_;
  std::vector<Settings> by_protocol_;
};

/// A fabric's id, and where it has several drapes which one.
std::string record_id(const Record& fabric, const Settings& settings) {
  return settings.dataset.protocols.empty() ? fabric.id
                                            : fabric.id + ":" + to_name(settings.start.protocol);
}

/// What the summary says of a fabric without a drape.
nlohmann::ordered_json failure(const Settings& settings, std::uint64_t seed, int index,
                               const Record& record, const std::filesystem::path& run) {
  const std::string number = std::to_string(index);
  return {{"index", index},
          {"id", record.id},
          {"seed", seed},
          {"status", record.stats.status},
          {"replay",
           replay_command(run, "replay_" + number,
                          {"dataset.only=[" + number + "]",
                           "dataset.radii=[" + shown(settings.scene.specimen_radius) + "]"})}};
}

/// The settings of the table of one specimen radius.
Settings with_radius(Settings settings, double radius) {
  settings.dataset.image_width *= radius / settings.scene.specimen_radius;
  settings.scene.specimen_radius = radius;
  settings.dataset.radii.clear();
  return settings;
}

/// One table and its picture; shards get theirs when they are merged.
RunOutcome drape_and_draw(const Settings& settings, OutputFolder& folder) {
  RunOutcome outcome = drape_dataset(settings, folder);
  if (!interrupted() && settings.dataset.shards == 1)
    draw_figure("dataset.py", folder / "results.h5", folder / "dataset");
  return outcome;
}

}  // namespace

RunOutcome drape_dataset(const Settings& settings, OutputFolder& folder) {
  const DatasetFabrics fabrics(settings);
  const Items items(settings, fabrics.chosen());
  const int count = items.count();
  const auto discretization = make_discretization(settings);
  const RecordStore store(folder.path(), records_header(settings, discretization->mesh()), count);
  const int resumed = store.finished();
  const double start = process_cpu_seconds();
  {
    Progress progress("dataset", count, resumed);
    for_each_item(count, settings.experiment.thread_count(), [&](int i) {
      if (store.has(i)) return;
      const Item item = items[i];
      const Record tag = fabrics[item.fabric];
      Record record = drape_record(item.settings, discretization, tag.fabric);
      record.id = record_id(tag, item.settings);
      copy_tag(tag, record);
      store.save(i, record);
      if (!converged(record)) progress.note("fabric " + record.id + ": " + record.stats.status);
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
    const int index = items[visited++].fabric;
    if (!converged(record))
      failures.push_back(failure(settings, fabrics.seed(index), index, record, folder.path()));
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
  const std::vector<double>& radii = settings.dataset.radii;
  if (radii.empty()) return drape_and_draw(settings, folder);
  RunOutcome outcome = drape_and_draw(with_radius(settings, radii.front()), folder);
  for (size_t i = 1; i < radii.size() && !interrupted(); ++i) {
    const std::string part = "radius_" + shown(1e3 * radii[i]) + "mm";
    outcome.summary[part] =
        run_part(part, drape_and_draw, Kind::dataset, with_radius(settings, radii[i]), folder);
    if (outcome.summary[part]["status"] != outcome.status) outcome.status = "partial";
  }
  return outcome;
}

}  // namespace drape
