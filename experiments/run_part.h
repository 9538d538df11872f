// Runs within a run: each keeps its results in a subfolder of its own.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "experiments/kinds.h"

namespace drape {

using RunFunction = RunOutcome (*)(const Settings&, OutputFolder&);

/// Runs a part of the run in `folder` in its subfolder `part`, or takes its finished result. Its
/// summary; when interrupted, {"status": "partial"} alone.
nlohmann::ordered_json run_part(const std::string& part, RunFunction run, Kind kind,
                                Settings settings, const OutputFolder& folder);

}  // namespace drape
