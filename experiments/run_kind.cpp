#include "experiments/run_kind.h"

#include <stdexcept>

namespace drape {

RunOutcome run_kind(const Settings& settings, OutputFolder& folder) {
  switch (settings.experiment.kind) {
    case Kind::drape:
      return run_drape(settings, folder);
    case Kind::dataset:
      return run_dataset(settings, folder);
    case Kind::estimate:
      return run_estimate(settings, folder);
    case Kind::photograph:
      return run_photograph(settings, folder);
    case Kind::photograph_set:
      return run_photograph_set(settings, folder);
    case Kind::gradient_check:
      return run_gradient_check(settings, folder);
    case Kind::robustness:
      return run_robustness(settings, folder);
    case Kind::quickstart:
      return run_quickstart(settings, folder);
    case Kind::validation:
      return run_validation(settings, folder);
    case Kind::accuracy:
      return run_accuracy(settings, folder);
    case Kind::photographs:
      return run_photographs(settings, folder);
    case Kind::identifiability:
      return run_identifiability(settings, folder);
    case Kind::work_precision:
      return run_work_precision(settings, folder);
    case Kind::stability:
      return run_stability(settings, folder);
    case Kind::ablation:
      return run_ablation(settings, folder);
    case Kind::gradient_precision:
      return run_gradient_precision(settings, folder);
    case Kind::estimation_precision:
      return run_estimation_precision(settings, folder);
    case Kind::tag_comparison:
      return run_tag_comparison(settings, folder);
    case Kind::paper:
      return run_paper(settings, folder);
    case Kind::branches:
      return run_branches(settings, folder);
  }
  throw std::logic_error("a kind of experiment without a function");
}

}  // namespace drape
