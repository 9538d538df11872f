// How often the intervals of estimates cover the truth, where it is known.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/records.h"

namespace drape {

/// {parameter: share of the estimates that succeeded whose interval of `deviations` standard
/// deviations of the logarithm, to both sides, holds the true value}; NaN of none.
nlohmann::ordered_json interval_coverage(const std::vector<Record>& records,
                                         const std::vector<Parameter>& parameters,
                                         double deviations);

/// The standard deviations of a Gaussian that hold 68 % and 95 %.
inline constexpr double k68 = 0.994, k95 = 1.960;

}  // namespace drape
