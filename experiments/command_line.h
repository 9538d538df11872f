// The command line of the program: what may be asked, and a helpful no to everything else.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/config.h"
#include "experiments/dataset_commands.h"

namespace drape {

enum class Command { run, validate, explain, info, estimate, dataset, tag };

/// What `tag` is asked about.
struct TagQuery {
  std::string type, composition;
  double density = 0;             ///< [kg/m^2]
  std::filesystem::path dataset;  ///< to learn from; empty: the tag model
};

struct CommandLine {
  Command command;
  std::optional<std::filesystem::path> file;  ///< config, or records for `info`
  std::vector<Assignment> assignments;        ///< of --set, --threads, --photo, ...
  std::filesystem::path out;
  std::string query;  ///< of `explain`
  DatasetCommand dataset;
  TagQuery tag;
};

/// Thrown for wrong use; what() says what is wrong, with a suggestion if a word is misspelt.
struct UsageError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// nullopt if all there was to do was to answer --help or --version (printed on stdout).
/// Throws UsageError, and ConfigError on a --set without "=".
std::optional<CommandLine> parse_command_line(int argc, const char* const* argv);

}  // namespace drape
