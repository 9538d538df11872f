// Runs the program in a folder of its own, as a user would.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <string>

#include "tests/experiments/scratch_folder.h"

namespace drape {

struct Ended {
  int exit_code;
  std::string text;  // stdout and stderr
  bool says(const std::string& part) const { return text.find(part) != std::string::npos; }
};

class ProgramInFolder : public testing::Test {
 protected:
  Ended shell(const std::string& command) const {
    FILE* pipe = popen(("cd " + scratch.path().string() + " && " + command + " 2>&1").c_str(), "r");
    std::string text;
    char buffer[4096];
    while (const size_t count = fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, count);
    const int status = pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
  }
  Ended drape(const std::string& arguments) const { return shell(DRAPE_PROGRAM " " + arguments); }

  const ScratchFolder scratch;
};

}  // namespace drape
