#include "experiments/dataset_merge.h"

#include <algorithm>
#include <stdexcept>

#include "core/records.h"
#include "core/sha256.h"
#include "core/virtual_records.h"
#include "experiments/config.h"
#include "experiments/config_text.h"

namespace drape {
namespace {

namespace fs = std::filesystem;

struct Shard {
  fs::path file;
  RecordsHeader header;
  Settings settings;
  size_t records;
};

void refuse_to_overwrite(const fs::path& out) {
  if (fs::exists(out))
    throw std::invalid_argument(out.string() + ": is there already; choose another name");
}

Shard read_shard(const fs::path& file) {
  Shard shard{file, read_header(file), {}, record_count(file)};
  shard.settings = parse_settings(shard.header.config, file.string() + ": its config", ".");
  const DatasetSettings& dataset = shard.settings.dataset;
  if (shard.settings.experiment.kind != Kind::dataset || dataset.shards == 1 ||
      !dataset.only.empty())
    throw std::invalid_argument(file.string() + ": is no shard; expected the results.h5 of a run " +
                                "of kind \"dataset\" with --shard K/N");
  return shard;
}

/// The settings of the whole set.
Settings without_shards(Settings settings) {
  settings.dataset.shard = settings.dataset.shards = 1;
  return settings;
}

std::string shard_name(const Shard& shard) {
  return "shard " + std::to_string(shard.settings.dataset.shard) + "/" +
         std::to_string(shard.settings.dataset.shards);
}

/// The shards in order; throws unless they are those of one set.
std::vector<Shard> ordered_shards(const std::vector<fs::path>& files) {
  std::vector<Shard> shards;
  for (const fs::path& file : files) shards.push_back(read_shard(file));
  std::sort(shards.begin(), shards.end(), [](const Shard& a, const Shard& b) {
    return a.settings.dataset.shard < b.settings.dataset.shard;
  });
  const Shard& first = shards.front();
  const int count = first.settings.dataset.shards;
  for (const Shard& shard : shards) {
    std::string other = differences(without_shards(first.settings), without_shards(shard.settings));
    if (shard.settings.dataset.shards != count)
      other = "dataset.shards = " + std::to_string(count) + ", here " +
              std::to_string(shard.settings.dataset.shards);
    if (!other.empty())
      throw std::invalid_argument(shard.file.string() + ": is not of the set of " +
                                  first.file.string() + "\n" + other);
    if (shard.header.rest_uv != first.header.rest_uv ||
        shard.header.triangles != first.header.triangles)
      throw std::invalid_argument(shard.file.string() + ": has another mesh than " +
                                  first.file.string());
  }
  for (size_t i = 1; i < shards.size(); ++i)
    if (shards[i].settings.dataset.shard == shards[i - 1].settings.dataset.shard)
      throw std::invalid_argument(shards[i - 1].file.string() + " and " + shards[i].file.string() +
                                  " are both " + shard_name(shards[i]));
  for (int shard = 1; shard <= count; ++shard)
    if (static_cast<size_t>(shard) > shards.size() ||
        shards[static_cast<size_t>(shard - 1)].settings.dataset.shard != shard)
      throw std::invalid_argument("shard " + std::to_string(shard) + "/" + std::to_string(count) +
                                  " is missing");
  return shards;
}

RecordsHeader merged_header(const std::vector<Shard>& shards) {
  RecordsHeader header = shards.front().header;
  header.config = write_settings(without_shards(shards.front().settings));
  for (const Shard& shard : shards)  // made by several versions: name them all
    if (header.git_commit.find(shard.header.git_commit) == std::string::npos)
      header.git_commit += " " + shard.header.git_commit;
  return header;
}

/// Hands out records of several files by their index in all, read some at a time.
class RecordSequence {
 public:
  explicit RecordSequence(const std::vector<Shard>& shards) : shards_(shards) {}

  /// To be called with 0, 1, ... in order.
  Record next() {
    while (place_ == shards_[shard_].records) ++shard_, place_ = 0;
    const Shard& shard = shards_[shard_];
    constexpr size_t kBlock = 64;
    if (place_ % kBlock == 0)
      block_ = read_records(shard.file, place_, std::min(kBlock, shard.records - place_));
    return std::move(block_[place_++ % kBlock]);
  }

 private:
  const std::vector<Shard>& shards_;
  size_t shard_ = 0, place_ = 0;
  std::vector<Record> block_;
};

}  // namespace

size_t merge_datasets(const fs::path& out, const std::vector<fs::path>& files, MergeMode mode) {
  refuse_to_overwrite(out);
  const std::vector<Shard> shards = ordered_shards(files);
  const RecordsHeader header = merged_header(shards);
  size_t count = 0;
  for (const Shard& shard : shards) count += shard.records;
  if (mode == MergeMode::virtual_view) {
    std::vector<fs::path> sources;
    for (const Shard& shard : shards) sources.push_back(shard.file);
    write_virtual_records(out, header, sources);
  } else {
    RecordSequence sequence(shards);
    write_records(out, header, count, [&](size_t) { return sequence.next(); });
  }
  write_checksum(out);
  return count;
}

size_t migrate_dataset(const fs::path& file, const fs::path& out) {
  refuse_to_overwrite(out);
  const std::vector<Shard> whole{{file, read_header(file), {}, record_count(file)}};
  RecordSequence sequence(whole);
  write_records(out, whole.front().header, whole.front().records,
                [&](size_t) { return sequence.next(); });
  write_checksum(out);
  return whole.front().records;
}

}  // namespace drape
