// kind = "dataset": the drapes of a table of tags or of random fabrics, in parallel over fabrics.
#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include "core/cpu_clock.h"
#include "estimation/tag.h"
#include "experiments/interrupt.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/random_fabric.h"
#include "experiments/record_store.h"

namespace drape {
namespace {

std::string composition_text(const std::vector<Fibre>& composition) {
  std::ostringstream text;
  for (const Fibre& fibre : composition)
    text << (text.tellp() > 0 ? "; " : "") << fibre.name << " " << fibre.percent;
  return text.str();
}

/// Fabrics with their tags: records still without a drape.
std::vector<Record> requested_records(const Settings& settings) {
  std::vector<Record> records;
  if (!settings.dataset.table.empty()) {
    for (const Tag& tag : read_tag_table(settings.dataset.table)) {
      Record record;
      record.id = record.name = tag.id;
      record.category = tag.category;
      record.subcategory = tag.subcategory;
      record.type = tag.type;
      record.composition = composition_text(tag.composition);
      record.fabric = first_parameters(tag);
      records.push_back(record);
      if (settings.dataset.rows > 0 && static_cast<int>(records.size()) == settings.dataset.rows)
        break;
    }
    return records;
  }
  for (int i = 0; i < settings.dataset.fabrics; ++i) {
    Random random(seed_of_item(settings.experiment.seed, static_cast<std::uint64_t>(i)));
    Record record;
    record.id = record.name = std::to_string(i);
    record.fabric = random_fabric(random);
    records.push_back(record);
  }
  return records;
}

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

}  // namespace

RunOutcome run_dataset(const Settings& settings, OutputFolder& folder) {
  const std::vector<Record> requested = requested_records(settings);
  const int count = static_cast<int>(requested.size());
  const auto discretization = make_discretization(settings);
  const RecordStore store(folder.path(), records_header(settings, discretization->mesh()), count);
  const int resumed = store.finished();
  const double start = process_cpu_seconds();
  {
    Progress progress("dataset", count, resumed);
    for_each_item(count, settings.experiment.thread_count(), [&](int i) {
      if (store.has(i)) return;
      const Record& tag = requested[static_cast<size_t>(i)];
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
  int failed = 0, on_support = 0, self_intersecting = 0;
  for (const Record& record : store.load_all()) {
    failed += !converged(record);
    on_support += record.stats.contact == "support";
    self_intersecting += record.stats.self_intersections > 0;
  }
  const int generated = count - resumed;
  RunOutcome outcome{failed == 0 ? "ok" : failed < count ? "partial" : "failed", {}};
  outcome.summary["requested"] = count;
  outcome.summary["generated"] = generated;
  outcome.summary["resumed"] = resumed;
  outcome.summary["failed"] = failed;
  outcome.summary["contact_with_support"] = on_support;
  outcome.summary["self_intersecting"] = self_intersecting;
  outcome.summary["vertices"] = discretization->mesh().vertex_count();
  outcome.summary["drapes_per_cpu_second"] =
      generated > 0 ? nlohmann::ordered_json(generated / cpu) : nullptr;
  return outcome;
}

}  // namespace drape
