#include "experiments/dataset_fabrics.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>

#include "core/random.h"
#include "estimation/fabric_import.h"
#include "estimation/random_tags.h"
#include "estimation/tag_model.h"
#include "experiments/random_fabric.h"

namespace drape {
namespace {

std::vector<Record> listed_fabrics(const DatasetSettings& dataset) {
  std::vector<Record> records;
  if (!dataset.parameters.empty()) {
    for (const TaggedFabric& imported : read_fabric_table(dataset.parameters))
      records.push_back(tagged(imported.tag, imported.fabric));
  } else if (!dataset.table.empty()) {
    for (const Tag& tag : read_tag_table(dataset.table))
      records.push_back(tagged(tag, first_parameters(tag)));
  }
  if (dataset.rows > 0 && static_cast<size_t>(dataset.rows) < records.size())
    records.resize(static_cast<size_t>(dataset.rows));
  return records;
}

}  // namespace

Record tagged(const Tag& tag, const Fabric& fabric) {
  Record record;
  record.id = record.name = tag.id;
  record.category = tag.category;
  record.subcategory = tag.subcategory;
  record.type = tag.type;
  record.composition = composition_text(tag.composition);
  record.fabric = fabric;
  return record;
}

Tag tag_of(const Record& record) {
  return {
      record.id,
      record.category,
      record.subcategory,
      record.type,
      record.composition.empty() ? std::vector<Fibre>{} : composition_from_text(record.composition),
      record.fabric.areal_density};
}

void copy_tag(const Record& from, Record& to) {
  to.name = from.name;
  to.category = from.category;
  to.subcategory = from.subcategory;
  to.type = from.type;
  to.composition = from.composition;
}

DatasetFabrics::DatasetFabrics(const Settings& settings)
    : settings_(settings),
      listed_(listed_fabrics(settings.dataset)),
      count_(listed_.empty() ? settings.dataset.fabrics : static_cast<int>(listed_.size())) {
  if (listed_.empty() && settings.dataset.tags == DatasetTags::model)
    tags_ = random_tags(count_, settings.experiment.seed);
}

std::vector<int> DatasetFabrics::chosen() const {
  const DatasetSettings& dataset = settings_.dataset;
  for (const int index : dataset.only)
    if (index >= count_)
      throw std::invalid_argument("dataset.only names fabric " + std::to_string(index) +
                                  "; the set has 0 to " + std::to_string(count_ - 1));
  if (!dataset.only.empty()) return dataset.only;
  // Shards are neighbouring stretches of the set, the same length within one.
  const auto start = [&](int shard) {
    return static_cast<int>(std::int64_t{count_} * shard / dataset.shards);
  };
  const int first = start(dataset.shard - 1);
  std::vector<int> indices(static_cast<size_t>(start(dataset.shard) - first));
  std::iota(indices.begin(), indices.end(), first);
  return indices;
}

std::uint64_t DatasetFabrics::seed(int index) const {
  return seed_of_item(settings_.experiment.seed, static_cast<std::uint64_t>(index));
}

Record DatasetFabrics::operator[](int index) const {
  const auto i = static_cast<size_t>(index);
  if (!listed_.empty()) return listed_[i];
  Random random(seed(index));
  if (!tags_.empty())
    return tagged(tags_[i], random_parameters(tags_[i], settings_.reading.threshold, random));
  Record record;
  record.id = record.name = std::to_string(index);
  record.fabric = random_fabric(random);
  return record;
}

}  // namespace drape
