#include "experiments/output_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>

#include "core/durable_file.h"
#include "experiments/config.h"
#include "experiments/config_text.h"

namespace drape {
namespace {

constexpr const char* kLock = ".drape.lock";
constexpr const char* kConfig = "config.toml";
constexpr const char* kSummary = "summary.json";

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::string& reason) {
  throw std::invalid_argument("output folder " + folder.string() + ": " + reason);
}

// What a start cut short by a kill leaves behind does not count as content.
bool has_content(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name != kLock && name != std::string(kConfig) + ".part") return true;
  }
  return false;
}

// Throws unless the folder is missing, empty or a run of these settings.
OutputFolder::State inspect(const std::filesystem::path& folder, const Settings& settings) {
  using State = OutputFolder::State;
  if (!std::filesystem::exists(folder)) return State::created;
  if (!std::filesystem::is_directory(folder)) refuse(folder, "is a file; must be a folder");
  if (!has_content(folder)) return State::created;
  const std::filesystem::path config = folder / kConfig;
  if (!std::filesystem::exists(config))
    refuse(folder, "has content that is no run; choose a new or an empty folder");

  std::ifstream stream(config, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)),
                         std::istreambuf_iterator<char>());
  std::string other;
  try {
    other = differences(parse_settings(text, config.string(), folder), settings);
  } catch (const ConfigError& error) {
    refuse(folder,
           std::string("its config cannot be read; choose another folder\n") + error.what());
  }
  if (!other.empty())
    refuse(folder, "holds a run with other settings; choose another folder\n" + other);
  return std::filesystem::exists(folder / kSummary) ? State::finished : State::resumed;
}

int lock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kLock;
  const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0)
    throw std::filesystem::filesystem_error("cannot open the lock of a run", file,
                                            std::error_code(errno, std::generic_category()));
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  const int reason = errno;
  close(descriptor);
  if (reason == EWOULDBLOCK) refuse(folder, "another process is at work in it");
  throw std::filesystem::filesystem_error("cannot lock", file,
                                          std::error_code(reason, std::generic_category()));
}

}  // namespace

OutputFolder::OutputFolder(const std::filesystem::path& folder, const Settings& settings)
    : path_(folder), state_(inspect(folder, settings)), lock_(-1) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (error) refuse(path_, "cannot be created: " + error.message());
  lock_ = lock(path_);
  try {
    state_ = inspect(path_, settings);  // again: it may have changed before the lock was ours
    if (state_ == State::created) write_text_durably(path_ / kConfig, write_settings(settings));
  } catch (...) {
    close(lock_);
    throw;
  }
}

// The lock file stays: to remove it would let two processes lock two files of the same name.
OutputFolder::~OutputFolder() { close(lock_); }

}  // namespace drape
