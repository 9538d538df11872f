// Runs an experiment of any kind.
#pragma once

#include "experiments/kinds.h"

namespace drape {

/// By the function of the settings' kind.
RunOutcome run_kind(const Settings& settings, OutputFolder& folder);

}  // namespace drape
