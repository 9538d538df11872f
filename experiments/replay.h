// Commands that a user can paste into a shell to do one item of a run again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drape {

/// drape run RUN/config.toml --out RUN/NAME with a --set for each of the assignments.
std::string replay_command(const std::filesystem::path& run, const std::string& name,
                           const std::vector<std::string>& assignments);

}  // namespace drape
