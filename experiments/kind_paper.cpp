// kind = "paper": the experiments of a list one after the other, and their figures on one page.
#include <fstream>
#include <iostream>

#include "core/durable_file.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/paper_parts.h"
#include "experiments/run_kind.h"
#include "experiments/run_part.h"

namespace drape {

RunOutcome run_paper(const Settings& settings, OutputFolder& folder) {
  using Json = nlohmann::ordered_json;
  const std::vector<PaperPart> parts = paper_parts(settings);
  RunOutcome outcome{"ok", {}};
  Json list = Json::array();
  for (const PaperPart& part : parts) {
    std::cerr << "Part " << list.size() + 1 << " of " << parts.size() << ": " << part.name << "\n";
    const Json summary =
        run_part(part.name, run_kind, part.settings.experiment.kind, part.settings, folder);
    if (interrupted()) return outcome;
    list.push_back({{"name", part.name},
                    {"config", part.config.string()},
                    {"status", summary["status"]},
                    {"cpu_seconds", summary["cpu_seconds"]}});
    if (part.settings.experiment.kind == Kind::dataset &&
        std::filesystem::exists(folder / part.name / "results.h5"))
      draw_figure("render.py", folder / part.name / "results.h5", folder / part.name / "renders");
  }
  write_durably(folder / "parts.json",
                [&](const std::filesystem::path& file) { std::ofstream(file) << list.dump(2); });
  draw_figure("paper.py", folder.path(), folder / "figures");
  outcome.summary["parts"] = std::move(list);
  std::cout << "The figures: " << (folder / "figures.html").string() << "\n";
  return outcome;
}

}  // namespace drape
