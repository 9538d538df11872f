// Progress of long work on stderr: done of total, pace, estimate of the time left.
//
// On a terminal one line is refreshed; in a log file a line appears every ten seconds or so.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace drape {

/// "dataset 12/100 (12 %), 3.1/s, 28 s left". `fresh` counts what was done in this session, within
/// `seconds`: the pace is theirs alone. No pace and no time left before the first of them.
std::string progress_line(std::string_view label, int done, int total, int fresh, double seconds);

/// "28 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

/// Safe to use from several threads.
class Progress {
 public:
  /// `already_done` of `total` items were there before (a resumed run).
  Progress(std::string label, int total, int already_done = 0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more item is done.
  void advance();
  /// A line of its own between the lines of progress.
  void note(std::string_view line);

 private:
  using Clock = std::chrono::steady_clock;
  void show(Clock::time_point now);

  std::mutex mutex_;
  const std::string label_;
  const int total_, already_done_;
  int done_;
  const bool terminal_;
  const Clock::time_point begin_;
  Clock::time_point shown_;
};

}  // namespace drape
