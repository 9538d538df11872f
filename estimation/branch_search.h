// Which branch an outline shows: several guided starts, and what counts as having found it.
//
// A fabric whose membrane is stiff on the mesh has many drapes with nearly the same outline, and a
// guided start finds one of them. On the right one a fit explains the outline to its noise; on a
// neighbour a misfit remains, whatever the parameters. So a fit that leaves a misfit is repeated
// from another start, laid along the outline with the parameters found so far.
#pragma once

#include <vector>

#include "estimation/estimate.h"

namespace drape {

/// How a drape is laid along an outline.
struct GuidedStart {
  int harmonics = 0;   ///< of the profile that are followed
  double kappa = 1;    ///< strength of the guide
  double bending = 1;  ///< factor on the bending stiffnesses of a solve before the one that counts
};

/// The starts in the order they are tried: as asked for, then held more tightly, then bent more
/// gently first.
std::vector<GuidedStart> guided_starts(const std::vector<double>& guide, int harmonics);

/// Whether an outline whose rms miss is `miss` standard deviations of a radius is explained: up to
/// 1.5. Noise with 31 independent values (15 harmonics) stays below with 99.99 %.
bool explains(double miss);

/// Whether an outcome with its miss is to be preferred to another: the better outcome, then the
/// smaller miss.
bool is_better(EstimateOutcome outcome, double miss, EstimateOutcome than, double than_miss);

}  // namespace drape
