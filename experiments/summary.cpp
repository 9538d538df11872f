#include "experiments/summary.h"

#include <sys/resource.h>

#include <cstdint>
#include <fstream>
#include <stdexcept>

#include "core/durable_file.h"
#include "core/version.h"
#include "experiments/config_keys.h"

namespace drape {
namespace {

constexpr const char* kFile = "summary.json";

}  // namespace

nlohmann::ordered_json summary(Kind kind, const RunOutcome& outcome, const RunStart& start) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start.wall;
  nlohmann::ordered_json all = {
      {"kind", name(kind)},
      {"status", outcome.status},
      {"cpu_seconds", process_cpu_seconds() - start.cpu_seconds},
      {"wall_seconds", wall.count()},
      {"peak_memory_bytes", std::int64_t{1024} * usage.ru_maxrss},  // Linux counts kibibytes
      {"version", version()},
      {"git_commit", git_commit()},
  };
  for (const auto& [key, value] : outcome.summary.items()) {
    if (all.contains(key)) throw std::logic_error("summary key '" + key + "' is given twice");
    all[key] = value;
  }
  return all;
}

std::string summary_text(const nlohmann::ordered_json& summary) {
  using Json = nlohmann::ordered_json;
  return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(const OutputFolder& folder, const nlohmann::ordered_json& summary) {
  write_text_durably(folder / kFile, summary_text(summary));
}

nlohmann::ordered_json read_summary(const OutputFolder& folder) {
  std::ifstream stream(folder / kFile);
  auto json = nlohmann::ordered_json::parse(stream, nullptr, false);
  if (!json.is_object() || !json.contains("status") || !json["status"].is_string())
    throw std::invalid_argument((folder / kFile).string() + ": is damaged; remove it to resume");
  return json;
}

std::string read_status(const OutputFolder& folder) { return read_summary(folder)["status"]; }

}  // namespace drape
