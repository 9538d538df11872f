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
namespace {

/// The rendered drapes of a table, drawn anew only after the table: they take far longer than a
/// figure.
void draw_renders(const std::filesystem::path& place) {
  namespace fs = std::filesystem;
  const fs::path table = place / "results.h5", picture = place / "renders.pdf";
  if (!fs::exists(table)) return;
  if (fs::exists(picture) && fs::last_write_time(picture) >= fs::last_write_time(table)) return;
  draw_figure("render.py", table, place / "renders");
}

}  // namespace

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
    if (part.settings.experiment.kind == Kind::dataset) draw_renders(folder / part.name);
  }
  write_durably(folder / "parts.json",
                [&](const std::filesystem::path& file) { std::ofstream(file) << list.dump(2); });
  draw_figure("paper.py", folder.path(), folder / "figures");
  outcome.summary["parts"] = std::move(list);
  std::cout << "The figures: " << (folder / "figures.html").string() << "\n";
  return outcome;
}

}  // namespace drape
