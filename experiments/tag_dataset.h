// What tags tell by the fabrics of a table of records.
#pragma once

#include <filesystem>
#include <functional>

#include "estimation/tag_regression.h"
#include "experiments/settings.h"

namespace drape {

/// The regression on the fabrics of a results.h5 that bear a tag, each once however many records it
/// has; drapes do not matter. Throws RecordError, and std::invalid_argument beginning with the file
/// like type_from_text, fibre_from_text and TagRegression.
TagRegression tag_regression(const std::filesystem::path& results);

/// What a tag says of some parameters.
using TagPrior = std::function<Prior(const std::vector<Parameter>&, const Tag&)>;

/// The tag model's word (prior_from_tag), or that of the regression on estimate.tag_dataset. Throws
/// like tag_regression, and std::invalid_argument if the thresholds of its fabrics are of the other
/// reading.
TagPrior tag_prior(const EstimateSettings& settings, BendingThreshold threshold);

}  // namespace drape
