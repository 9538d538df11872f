// What a tag tells, as a table for people.
#pragma once

#include <string>

#include "core/fabric.h"

namespace drape {

/// Parameters with their ranges by the tag model. `density` in kg/m^2. Throws
/// std::invalid_argument on unknown types and fibres, percentages that do not sum to 100, and a
/// density that is not positive or looks like g/m^2.
std::string tag_report(const std::string& type, const std::string& composition, double density,
                       BendingThreshold threshold);

}  // namespace drape
