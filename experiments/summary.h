// summary.json: what a run came to, for people and scripts.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>

#include "core/cpu_clock.h"
#include "experiments/kinds.h"
#include "experiments/output_folder.h"
#include "experiments/settings.h"

namespace drape {

/// When a run began, on the wall and in CPU of this process.
struct RunStart {
  std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
  double cpu_seconds = process_cpu_seconds();
};

/// The keys that all kinds share (kind, status, cpu_seconds and wall_seconds since `start`,
/// peak_memory_bytes of this process, version, git_commit), then the kind's own, which must not
/// repeat them (std::logic_error). A resumed run counts its last session only.
nlohmann::ordered_json summary(Kind kind, const RunOutcome& outcome, const RunStart& start);

/// As text: NaN and infinity become null, bytes that are not UTF-8 U+FFFD.
std::string summary_text(const nlohmann::ordered_json& summary);

/// Writes summary.json durably, which marks the run as finished.
void write_summary(const OutputFolder& folder, const nlohmann::ordered_json& summary);

/// summary.json of a finished run; throws std::invalid_argument if it is damaged.
nlohmann::ordered_json read_summary(const OutputFolder& folder);
/// Its "status"; throws std::invalid_argument if its summary.json is damaged.
std::string read_status(const OutputFolder& folder);

}  // namespace drape
