#include "experiments/replay.h"

namespace drape {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

std::string replay_command(const std::filesystem::path& run, const std::string& name,
                           const std::vector<std::string>& assignments) {
  std::string command = "drape run " + quoted((run / "config.toml").string()) + " --out " +
                        quoted((run / name).string());
  for (const std::string& assignment : assignments) command += " --set " + quoted(assignment);
  return command;
}

}  // namespace drape
