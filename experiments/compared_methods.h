// Which methods a study compares, and what CPU time it gives each.
#pragma once

#include <vector>

#include "benchmarks/baselines/methods.h"
#include "experiments/settings.h"

namespace drape {

/// The methods chosen; all of them if none is.
inline std::vector<const baselines::Method*> compared_methods(
    const std::vector<ComparedMethod>& chosen) {
  std::vector<const baselines::Method*> list;
  for (const ComparedMethod m : chosen)
    list.push_back(&baselines::methods()[static_cast<size_t>(m)]);
  if (list.empty())
    for (const baselines::Method& m : baselines::methods()) list.push_back(&m);
  return list;
}

/// CPU seconds of a run, from those at a thousand vertices.
inline double budget_of_size(double cpu_seconds, int vertices) {
  return cpu_seconds * vertices / 1000;
}

}  // namespace drape
