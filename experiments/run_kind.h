// Runs an experiment of any kind, alone or as a part of another.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "experiments/kinds.h"

namespace drape {

/// The function of the settings' kind.
RunOutcome run_kind(const Settings& settings, OutputFolder& folder);

using RunFunction = RunOutcome (*)(const Settings&, OutputFolder&);

/// Runs a part of an experiment in the subfolder `part` of its own, or takes its finished result.
/// Its summary, or no more than a status where it was interrupted.
nlohmann::ordered_json run_part(const std::string& part, const Settings& settings,
                                const OutputFolder& folder, RunFunction run = run_kind);

}  // namespace drape
