#include "experiments/run_part.h"

#include <utility>

#include "experiments/interrupt.h"
#include "experiments/summary.h"

namespace drape {

nlohmann::ordered_json run_part(const std::string& part, RunFunction run, Kind kind,
                                Settings settings, const OutputFolder& folder) {
  const RunStart start;
  settings.experiment.kind = kind;
  OutputFolder part_folder(folder / part, settings);
  if (part_folder.state() == OutputFolder::State::finished) return read_summary(part_folder);
  const RunOutcome outcome = run(settings, part_folder);
  if (interrupted()) return {{"status", "partial"}};
  nlohmann::ordered_json result = summary(kind, outcome, start);
  write_summary(part_folder, result);
  return result;
}

}  // namespace drape
