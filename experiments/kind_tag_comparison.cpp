// kind = "tag_comparison": what the tag, the picture and both tell of a fabric's parameters, beside
// a regressor that learned from other fabrics (the source's own route).
//
// All fabrics are of the tag model. What every method is told besides: the weight.
//   tag       the mean of the tag model given the tag
//   picture   a fit without the tag, from what the weight suggests for a woven
//   both      a fit with the tag's mean and covariance as prior
//   learned   scikit-learn's, from tag and outline (figures/tag_comparison.py)
#include <filesystem>
#include <fstream>

#include "core/durable_file.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/run_part.h"

namespace drape {

RunOutcome run_tag_comparison(const Settings& settings, OutputFolder& folder) {
  RunOutcome outcome{"ok", {}};
  nlohmann::ordered_json parts;

  Settings training = settings;
  training.dataset.tags = DatasetTags::model;
  training.dataset.fabrics = settings.tag_comparison.training;
  parts["training"] = run_part("training", drape_dataset, Kind::dataset, training, folder);
  if (interrupted()) return outcome;

  Settings held_out = training;  // of another seed, other fabrics
  held_out.experiment.seed = settings.experiment.seed + 1;
  held_out.dataset.fabrics = settings.tag_comparison.held_out;
  parts["held_out"] = run_part("held_out", drape_dataset, Kind::dataset, held_out, folder);
  if (interrupted()) return outcome;

  Settings picture = held_out;
  picture.estimate.dataset = std::filesystem::absolute(folder / "held_out/results.h5");
  picture.estimate.first = FirstParameters::weight;
  picture.estimate.prior = PriorKind::start;
  parts["picture"] = run_part("picture", run_estimate, Kind::estimate, picture, folder);
  if (interrupted()) return outcome;

  Settings both = picture;
  both.estimate.first = FirstParameters::tag;
  both.estimate.prior = PriorKind::tag;
  parts["both"] = run_part("both", run_estimate, Kind::estimate, both, folder);
  if (interrupted()) return outcome;

  write_durably(folder / "results.h5", [&](const std::filesystem::path& part) {
    std::filesystem::copy_file(folder / "both/results.h5", part,
                               std::filesystem::copy_options::overwrite_existing);
  });
  draw_figure("tag_comparison.py", folder / "results.h5", folder / "tag_comparison");
  std::ifstream numbers(folder / "tag_comparison.json");
  outcome.summary["comparison"] = nlohmann::ordered_json::parse(numbers);
  outcome.summary["parts"] = parts;
  // a fit that ended elsewhere is a finding that the figure counts; a missing drape is a failure
  for (const char* part : {"training", "held_out"})
    if (parts[part]["status"] != "ok") outcome.status = "partial";
  return outcome;
}

}  // namespace drape
