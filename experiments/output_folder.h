// The folder of one run: created, resumed or refused, and never overwritten.
//
// It holds config.toml (the resolved settings), what the run adds, and at the end summary.json: a
// folder with a summary is a finished run. A lock keeps other processes out while a run is at work.
#pragma once

#include <filesystem>
#include <string_view>

#include "experiments/settings.h"

namespace drape {

class OutputFolder {
 public:
  enum class State {
    created,   ///< new or was empty
    resumed,   ///< an unfinished run of the same settings (threads may differ)
    finished,  ///< a finished run of the same settings: to be left alone
  };

  /// Creates the folder (and those above it) or takes up what is there. Throws
  /// std::invalid_argument if it is a file, has content that is not a run of the same settings, or
  /// is in use by another process, and std::filesystem::filesystem_error where the disk refuses.
  OutputFolder(const std::filesystem::path& folder, const Settings& settings);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  State state() const { return state_; }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
  State state_;
  int lock_;  ///< descriptor of the locked file
};

}  // namespace drape
