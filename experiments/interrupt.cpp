#include "experiments/interrupt.h"

#include <time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

namespace drape {
namespace {

// Written by the handler and read by all threads; lock-free, so a handler may touch it.
std::atomic<bool> interrupt_flag = false;
std::atomic<double> first_seconds = 0;
static_assert(std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<double>::is_always_lock_free);

// timeout(1) and some batch systems signal a process and then its whole group: that counts as one.
constexpr double kSameSignalSeconds = 0.5;

double seconds_now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void on_signal(int signal) {
  if (interrupt_flag) {
    if (seconds_now() - first_seconds < kSameSignalSeconds) return;
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // takes effect when the handler returns
    return;
  }
  first_seconds = seconds_now();
  interrupt_flag = true;
  constexpr std::string_view kMessage =
      "\ninterrupted: finishing the records at work; once more stops at once\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kMessage.data(), kMessage.size());
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;  // a signal must not fail the write of a record
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return interrupt_flag; }

}  // namespace drape
