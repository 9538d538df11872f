// kind = "drape" with start.protocol = "ensemble": every start is an item of its own, in parallel
// and resumable; the distinct minima become the records.
#pragma once

#include "experiments/kinds.h"

namespace drape {

/// results.h5 gets one record a minimum, lowest energy first. The summary is that of the lowest one
/// and lists all: `minima`, `drape_coefficient_interval_percent`, `starts`, `distinct_shapes`.
RunOutcome drape_ensemble(const Settings& settings, OutputFolder& folder);

}  // namespace drape
