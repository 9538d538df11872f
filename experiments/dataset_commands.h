// The commands `drape dataset ...`, `drape tag` and what they were asked.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drape {

enum class DatasetAction { merge, verify, migrate, export_csv, export_obj, export_vtu };

struct DatasetCommand {
  DatasetAction action = DatasetAction::verify;
  std::vector<std::filesystem::path> files;  ///< inputs
  std::filesystem::path out;                 ///< but of verify
  bool virtual_view = false;                 ///< of merge
  int record = 0;                            ///< of export_obj and export_vtu
  int sample = 10;                           ///< of verify: drapes to compute again
};

/// Does it in a process of its own (isolated.h) and prints what came out. Returns the exit code.
/// Throws RecordError and std::invalid_argument.
int run_dataset_command(const DatasetCommand& command);

}  // namespace drape
