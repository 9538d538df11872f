// kind = "quickstart": the whole path in one run. Tags -> first parameters -> drapes -> dataset ->
// parameters wrong by a factor -> estimated back from the silhouettes -> one sheet; and, where it
// is there, the photograph of a real drape -> parameters.
#include <filesystem>
#include <iostream>

#include "core/durable_file.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/run_part.h"

namespace drape {
RunOutcome run_quickstart(const Settings& settings, OutputFolder& folder) {
  const QuickstartSettings& quickstart = settings.quickstart;
  RunOutcome outcome{"ok", {}};

  Settings dataset = settings;
  dataset.dataset.table = quickstart.table;
  dataset.dataset.rows = quickstart.fabrics;
  outcome.summary["dataset"] = run_part("dataset", drape_dataset, Kind::dataset, dataset, folder);
  if (interrupted()) return outcome;

  Settings estimate = settings;
  estimate.estimate.dataset = std::filesystem::absolute(folder / "dataset/results.h5");
  outcome.summary["estimate"] =
      run_part("estimate", run_estimate, Kind::estimate, estimate, folder);
  if (interrupted()) return outcome;

  // the estimates' table holds the dataset's columns as well: it is this run's own result
  write_durably(folder / "results.h5", [&](const std::filesystem::path& part) {
    std::filesystem::copy_file(folder / "estimate/results.h5", part,
                               std::filesystem::copy_options::overwrite_existing);
  });
  draw_figure("drape_sheet.py", folder / "results.h5", folder / "sheet");

  if (!quickstart.photograph.empty() && std::filesystem::exists(quickstart.photograph)) {
    Settings photograph = settings;
    photograph.photograph.files = {quickstart.photograph};
    photograph.photograph.mm_per_pixel = quickstart.mm_per_pixel;
    photograph.photograph.areal_density = quickstart.areal_density;
    photograph.estimate.method = FitMethod::levenberg_marquardt;
    outcome.summary["photograph"] =
        run_part("photograph", run_photograph, Kind::photograph, photograph, folder);
  } else if (!quickstart.photograph.empty()) {
    std::cout << "No photograph at " << quickstart.photograph.string()
              << ": that part is skipped\n";
  }

  // a lost branch is a finding that the sheet shows; a fabric without a drape is a failure
  outcome.status = outcome.summary["dataset"]["status"];
  std::cout << "The sheet: " << (folder / "sheet.pdf").string() << " and .png\n";
  return outcome;
}

}  // namespace drape
