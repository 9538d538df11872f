// How a recovery of known parameters ended: what counts as recovered, why the others failed, and
// the summary over all.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/records.h"
#include "experiments/settings.h"

namespace drape {

/// What became of a target with an estimate, its parameters known:
///   recovered            every k_b within 2 %, k_h within 10 % (any other parameter within 2 %)
///   wrong_node_count     converged on a drape with another number of nodes
///   neighbouring_branch  converged with the outline missed by more than 1 % of the stated noise:
///                        exact data have no misfit at the truth
///   insensitive          converged with no misfit, not at the truth: the outline does not decide
///   bounds               a parameter ended at its bound, whatever the outcome
///   no_start, branch_lost, misfit, not_converged and other outcomes of an estimate: as they are
std::string recovery_class(const Record& record, const EstimateSettings& settings);

/// The keys of summary.json, with tables of errors by drape coefficient and by type. Records
/// without an estimate count as fabrics only.
nlohmann::ordered_json recovery_summary(const EstimateSettings& settings,
                                        const std::vector<Record>& records);

}  // namespace drape
