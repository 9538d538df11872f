// kind = "tag_comparison": what the tag, the picture and both tell of a fabric's parameters, beside
// regressions on other fabrics: on the tag, and on tag and picture (the source's own route).
//
// All fabrics are of the tag model. What every method is told besides: the weight.
//   tag         the mean of the tag model given the tag
//   regression  from the tag alone, on the training fabrics (TagRegression)
//   picture     a fit without the tag, from what the weight suggests for a woven
//   both        a fit with the tag model's mean and covariance as prior
//   learned     scikit-learn's, from tag and outline (figures/tag_comparison.py)
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/durable_file.h"
#include "core/records.h"
#include "experiments/dataset_fabrics.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/run_part.h"
#include "experiments/tag_dataset.h"

namespace drape {
namespace {

/// Mean and standard deviation of z of the held-out fabrics, as the figure reads them.
nlohmann::ordered_json regression_of(const std::filesystem::path& training,
                                     const std::filesystem::path& held_out,
                                     const std::vector<Parameter>& parameters) {
  const TagRegression regression = tag_regression(training);
  nlohmann::ordered_json said{{"fabrics", regression.fabrics()}};
  for (const Parameter p : parameters)
    said["r_squared"][std::string(name(p))] = regression.validation(p).r_squared;
  visit_records(held_out, [&](size_t, const Record& record) {
    const Prior prior = regression.predict(parameters, tag_of(record));
    for (size_t i = 0; i < parameters.size(); ++i) {
      const std::string key(name(parameters[i]));
      const auto k = static_cast<Eigen::Index>(i);
      said["mean"][key].push_back(prior.mean[k]);
      said["sd"][key].push_back(std::sqrt(prior.covariance(k, k)));
    }
  });
  return said;
}

}  // namespace

RunOutcome run_tag_comparison(const Settings& settings, OutputFolder& folder) {
  RunOutcome outcome{"ok", {}};
  nlohmann::ordered_json parts;

  Settings training = settings;
  training.dataset.tags = DatasetTags::model;
  training.estimate.tag_dataset.clear();
  training.dataset.fabrics = settings.tag_comparison.training;
  parts["training"] = run_part("training", drape_dataset, Kind::dataset, training, folder);
  if (interrupted()) return outcome;

  Settings held_out = training;  // of another seed, other fabrics
  held_out.experiment.seed = settings.experiment.seed + 1;
  held_out.dataset.fabrics = settings.tag_comparison.held_out;
  parts["held_out"] = run_part("held_out", drape_dataset, Kind::dataset, held_out, folder);
  if (interrupted()) return outcome;
  write_text_durably(folder / "tag_regression.json",
                     regression_of(folder / "training/results.h5", folder / "held_out/results.h5",
                                   settings.estimate.parameters)
                         .dump(2));

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
