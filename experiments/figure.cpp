#include "experiments/figure.h"

#include <spawn.h>
#include <sys/wait.h>

#include <cstring>
#include <stdexcept>
#include <vector>

extern char** environ;

namespace drape {

void draw_figure(const std::string& script, const std::filesystem::path& results,
                 const std::filesystem::path& stem) {
  const std::filesystem::path program =
      std::filesystem::path(DRAPE_SOURCE_DIR) / "experiments" / "figures" / script;
  std::vector<std::string> words{"/usr/bin/python3", "-B",    program.string(),
                                 results.string(),   "--out", stem.string()};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (const int error =
          posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), environ))
    throw std::runtime_error("figure " + script + ": cannot start python: " + strerror(error));
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("figure " + script + " of " + results.string() +
                             " failed; see the messages above");
}

}  // namespace drape
