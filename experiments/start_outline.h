// The outline that a guided start follows: a polygon in a CSV, or a record of a dataset.
#pragma once

#include "core/types.h"
#include "experiments/settings.h"

namespace drape {

/// kProfileSize radii about the axis of the support [m]. Throws std::invalid_argument, or
/// RecordError for a dataset, on files that hold no such outline.
VecX start_profile(const Settings& settings);

}  // namespace drape
