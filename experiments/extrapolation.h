// The limit of values whose error falls with a power of a step.
#pragma once

#include <cmath>

namespace drape {

/// Of a value (a number or a vector) with a step and one with a step `ratio` times smaller, errors
/// as step^order: without that order (Richardson 1911). Not finite for a ratio of 1.
template <typename Value>
Value extrapolated(const Value& value, const Value& with_smaller_step, double ratio, int order) {
  return with_smaller_step + (with_smaller_step - value) / (std::pow(ratio, order) - 1);
}

}  // namespace drape
