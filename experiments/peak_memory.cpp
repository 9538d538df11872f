#include "experiments/peak_memory.h"

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace drape {
namespace {

/// A line "NAME:  N kB" of /proc/self/status [byte]; NaN if there is none.
double status_bytes(const std::string& name) {
  std::ifstream stream("/proc/self/status");
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(name + ":")) return 1024 * std::stod(line.substr(name.size() + 1));
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double peak_memory_growth(const std::function<void()>& work) {
  malloc_trim(0);  // or freed memory would be used again unseen
  const bool reset = static_cast<bool>(std::ofstream("/proc/self/clear_refs") << "5" << std::flush);
  const double before = status_bytes("VmRSS");
  work();
  if (!reset) return std::numeric_limits<double>::quiet_NaN();
  return std::max(0.0, status_bytes("VmHWM") - before);
}

}  // namespace drape
