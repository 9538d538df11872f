// The kinds of experiments, one function each (kind_*.cpp).
//
// A kind keeps what it finishes in its folder, takes up what is there already, reports progress on
// stderr, and polls interrupted() between records: then it returns early and the program leaves the
// run unfinished. Bad input is thrown as std::invalid_argument; a failed solve is part of the
// outcome.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "experiments/output_folder.h"
#include "experiments/settings.h"

namespace drape {

struct RunOutcome {
  std::string status;              ///< "ok", "partial" (some solve failed) or "failed" (all did)
  nlohmann::ordered_json summary;  ///< the kind's own keys of summary.json: an object or null
};

RunOutcome run_drape(const Settings& settings, OutputFolder& folder);
RunOutcome run_dataset(const Settings& settings, OutputFolder& folder);
/// One table of it, without its picture: dataset.radii is no matter.
RunOutcome drape_dataset(const Settings& settings, OutputFolder& folder);
RunOutcome run_estimate(const Settings& settings, OutputFolder& folder);
RunOutcome run_photograph(const Settings& settings, OutputFolder& folder);
RunOutcome run_photograph_set(const Settings& settings, OutputFolder& folder);
RunOutcome run_gradient_check(const Settings& settings, OutputFolder& folder);
RunOutcome run_robustness(const Settings& settings, OutputFolder& folder);
RunOutcome run_quickstart(const Settings& settings, OutputFolder& folder);
RunOutcome run_validation(const Settings& settings, OutputFolder& folder);
RunOutcome run_accuracy(const Settings& settings, OutputFolder& folder);
RunOutcome run_photographs(const Settings& settings, OutputFolder& folder);
RunOutcome run_identifiability(const Settings& settings, OutputFolder& folder);
RunOutcome run_work_precision(const Settings& settings, OutputFolder& folder);
RunOutcome run_stability(const Settings& settings, OutputFolder& folder);
RunOutcome run_ablation(const Settings& settings, OutputFolder& folder);
RunOutcome run_gradient_precision(const Settings& settings, OutputFolder& folder);
RunOutcome run_estimation_precision(const Settings& settings, OutputFolder& folder);
RunOutcome run_branches(const Settings& settings, OutputFolder& folder);
RunOutcome run_tag_comparison(const Settings& settings, OutputFolder& folder);
RunOutcome run_paper(const Settings& settings, OutputFolder& folder);

}  // namespace drape
