// What a tag tells: a documented model from type, fibres and weight to parameters with scatter.
//
// Medians of stretch and shear are those of first_parameters (tag.h); bending is the measured
// regression on the density with its measured scatter and correlations (measured_bending.h), as a
// bending test gives it. Every other coefficient is commented at its place as measured, derived or
// assumed.
#pragma once

#include <array>
#include <vector>

#include "core/fabric.h"
#include "core/random.h"
#include "estimation/tag.h"

namespace drape {

/// One fabric of those that bear this tag. In the reading "radius" softening is as measured; the
/// thresholds of "printed" have no measured counterpart: there s_b and t_b are those of
/// first_parameters. Throws like first_parameters. Takes any number of values from `random`.
Fabric random_parameters(const Tag& tag, BendingThreshold threshold, Random& random);

/// 4000 of them with a fixed seed: what is drawn for one purpose is what another sees.
std::vector<Fabric> drawn_fabrics(const Tag& tag, BendingThreshold threshold);

/// Percentiles of one parameter over the fabrics that bear a tag, in the parameter's unit.
struct ParameterRange {
  double low, median, high;  ///< 5, 50 and 95 %
};

/// Over drawn_fabrics: the percentiles are good to some per cent.
std::array<ParameterRange, kParameterCount> parameter_ranges(const Tag& tag,
                                                             BendingThreshold threshold);

}  // namespace drape
