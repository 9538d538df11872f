#include "experiments/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace drape {
namespace {

constexpr std::chrono::milliseconds kTerminalPause(100);
constexpr std::chrono::seconds kLogPause(10);

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 100 ? "%.2g" : "%.0f", value);
  return text;
}

}  // namespace

std::string duration_text(double seconds) {
  const long long whole = std::llround(seconds);
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

std::string progress_line(std::string_view label, int done, int total, int fresh, double seconds) {
  std::string line(label);
  line += " " + std::to_string(done) + "/" + std::to_string(total);
  if (total > 0) line += " (" + std::to_string(100LL * done / total) + " %)";
  if (fresh == 0 || !(seconds > 0)) return line;
  const double pace = fresh / seconds;
  line += pace >= 1 ? ", " + short_number(pace) + "/s" : ", " + short_number(1 / pace) + " s each";
  if (done < total) return line + ", " + duration_text((total - done) / pace) + " left";
  return line + ", took " + duration_text(seconds);
}

Progress::Progress(std::string label, int total, int already_done)
    : label_(std::move(label)),
      total_(total),
      already_done_(already_done),
      done_(already_done),
      terminal_(isatty(STDERR_FILENO) == 1),
      begin_(Clock::now()),
      shown_(begin_) {
  show(begin_);
}

Progress::~Progress() {
  if (terminal_) std::fputc('\n', stderr);
}

void Progress::advance() {
  const std::scoped_lock lock(mutex_);
  ++done_;
  const Clock::time_point now = Clock::now();
  const Clock::duration pause = terminal_ ? Clock::duration(kTerminalPause) : kLogPause;
  if (done_ >= total_ || now - shown_ >= pause) show(now);
}

void Progress::note(std::string_view line) {
  const std::scoped_lock lock(mutex_);
  std::fprintf(stderr, "%s%.*s\n", terminal_ ? "\r\033[K" : "", static_cast<int>(line.size()),
               line.data());
  if (terminal_) show(Clock::now());
}

void Progress::show(Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const std::string line = progress_line(label_, done_, total_, done_ - already_done_, seconds);
  if (terminal_)
    std::fprintf(stderr, "\r\033[K%s", line.c_str());
  else
    std::fprintf(stderr, "%s\n", line.c_str());
  std::fflush(stderr);
  shown_ = now;
}

}  // namespace drape
