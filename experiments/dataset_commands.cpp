#include "experiments/dataset_commands.h"

#include <iostream>

#include "core/records.h"
#include "core/sha256.h"
#include "experiments/dataset_export.h"
#include "experiments/dataset_merge.h"
#include "experiments/dataset_verify.h"
#include "experiments/isolated.h"

namespace drape {
namespace {

void act(const DatasetCommand& command) {
  const std::filesystem::path& file = command.files.front();
  const auto record = static_cast<size_t>(command.record);
  switch (command.action) {
    case DatasetAction::merge:
      std::cout << merge_datasets(command.out, command.files,
                                  command.virtual_view ? MergeMode::virtual_view : MergeMode::copy)
                << " records in " << command.out.string() << "\n";
      return;
    case DatasetAction::verify:
      std::cout << verify_records(file, command.sample);
      return;
    case DatasetAction::migrate:
      std::cout << migrate_dataset(file, command.out) << " records in " << command.out.string()
                << "\n";
      return;
    case DatasetAction::export_csv:
      return export_csv(file, command.out);
    case DatasetAction::export_obj:
      return export_obj(file, record, command.out);
    case DatasetAction::export_vtu:
      return export_vtu(file, record, command.out);
  }
}

}  // namespace

int run_dataset_command(const DatasetCommand& command) {
  std::string names;
  for (const std::filesystem::path& file : command.files) {
    if (!std::filesystem::is_regular_file(file))
      throw RecordError(file.string() + ": no such file");
    const std::string bytes = verify_bytes(file);
    if (command.action == DatasetAction::verify) std::cout << bytes;
    names += (names.empty() ? "" : ", ") + file.string();
  }
  return isolated(names, [&] {
    act(command);
    return 0;
  });
}

}  // namespace drape
