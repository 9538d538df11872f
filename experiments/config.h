// Config files: TOML text -> Settings, with errors that say where, what, and what would be right.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/settings.h"

namespace drape {

/// what() holds a line for every mistake: "FILE:LINE:COLUMN: ..." or "--set ...: ...".
struct ConfigError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A value from the command line. `value` is TOML, but texts may come without quotes and
/// numbers with a leading dot; paths are relative to the current folder. `origin` is what errors
/// name, as "--set mesh.seed=x".
struct Assignment {
  std::string key;
  std::string value;
  std::string origin;
};

/// The assignment of a `--set section.key=value`; throws ConfigError if there is no "=".
Assignment assignment_from_set(const std::string& text);

/// Settings of a config file with assignments on top (without a file: on top of the defaults).
/// Every key but experiment.kind may be missing. Throws ConfigError on unknown keys and sections,
/// wrong types, values out of range, files named in it that do not exist, settings that do not fit
/// together, and files that cannot be read as TOML.
Settings read_settings(const std::optional<std::filesystem::path>& file,
                       const std::vector<Assignment>& assignments = {});

/// The same for a text; `name` stands for the file in errors and paths are relative to `folder`.
/// Looks at each key alone: not whether files exist and settings fit together.
Settings parse_settings(std::string_view text, const std::string& name,
                        const std::filesystem::path& folder);

}  // namespace drape
