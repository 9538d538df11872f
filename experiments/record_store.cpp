#include "experiments/record_store.h"

#include <cstdio>
#include <utility>

namespace drape {

RecordStore::RecordStore(const std::filesystem::path& folder, RecordsHeader header, int count)
    : table_(folder / "results.h5"),
      records_(folder / "records"),
      header_(std::move(header)),
      count_(count) {
  std::filesystem::create_directories(records_);
}

std::filesystem::path RecordStore::file(int index) const {
  char name[32];
  std::snprintf(name, sizeof name, "%06d.h5", index);
  return records_ / name;
}

// The table is written last, and only when it is complete.
bool RecordStore::has(int index) const {
  return std::filesystem::exists(table_) || std::filesystem::exists(file(index));
}

int RecordStore::finished() const {
  int finished = 0;
  for (int i = 0; i < count_; ++i) finished += has(i);
  return finished;
}

void RecordStore::save(int index, const Record& record) const {
  write_records(file(index), header_, {record});
}

Record RecordStore::load(int index) const {
  if (std::filesystem::exists(table_))
    return read_records(table_, static_cast<size_t>(index), 1).at(0);
  return read_records(file(index)).at(0);
}

void RecordStore::visit(const std::function<void(const Record&)>& visit) const {
  if (std::filesystem::exists(table_))
    visit_records(table_, [&](size_t, const Record& record) { visit(record); });
  else
    for (int i = 0; i < count_; ++i) visit(load(i));
}

std::vector<Record> RecordStore::load_all() const {
  std::vector<Record> records;
  visit([&](const Record& record) { records.push_back(record); });
  return records;
}

void RecordStore::consolidate() const {
  if (!std::filesystem::exists(table_))
    write_records(table_, header_, static_cast<size_t>(count_),
                  [&](size_t index) { return load(static_cast<int>(index)); });
  std::filesystem::remove_all(records_);
}

}  // namespace drape
