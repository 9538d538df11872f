// What a tag tells, as a table for people.
#pragma once

#include <filesystem>
#include <string>

#include "core/fabric.h"
#include "estimation/tag.h"

namespace drape {

/// A tag as people write it, `density` in kg/m^2. Throws std::invalid_argument on unknown types and
/// fibres, percentages that do not sum to 100, and a density that is not positive or looks like
/// g/m^2.
Tag tag_from_words(const std::string& type, const std::string& composition, double density);

/// Parameters with their ranges by the tag model.
std::string tag_report(const Tag& tag, BendingThreshold threshold);

/// The same by the regression on the fabrics of a results.h5, and how well it predicts them. Throws
/// like tag_regression.
std::string tag_report(const Tag& tag, const std::filesystem::path& results);

}  // namespace drape
