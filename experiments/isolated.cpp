#include "experiments/isolated.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <new>
#include <stdexcept>
#include <system_error>

namespace drape {
namespace {

pid_t start_child() {
  std::cout.flush();
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start a process");
  return child;
}

/// The child's exit code; throws if it crashed.
int exit_code_of(pid_t child, const std::string& file) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
  if (WIFSIGNALED(status))
    throw std::invalid_argument(file + ": is damaged: the program that read it crashed (" +
                                strsignal(WTERMSIG(status)) + ")");
  return WEXITSTATUS(status);
}

}  // namespace

int isolated(const std::string& file, const std::function<int()>& work) {
  const pid_t child = start_child();
  if (child != 0) return exit_code_of(child, file);
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw std::invalid_argument(file + ": is damaged: it asks for more memory than there is");
  } catch (const std::length_error&) {
    throw std::invalid_argument(file + ": is damaged: it has sizes that cannot be");
  }
}

void probe(const std::string& file, const std::function<void()>& work) {
  const pid_t child = start_child();
  if (child != 0) {
    exit_code_of(child, file);
    return;
  }
  try {
    work();
  } catch (...) {
  }
  _exit(0);
}

}  // namespace drape
