// Which branch an outline shows: several guided starts, and what counts as having found it.
//
// A fabric whose membrane is stiff on the mesh has many drapes with nearly the same outline, and a
// guided start finds one of them. On the right one a fit explains the outline to its noise; on a
// neighbour a misfit remains, whatever the parameters. So a fit that leaves a misfit is repeated
// from another start, laid along the outline with the parameters found so far.
#pragma once

#include <vector>

namespace drape {

struct Estimate;

/// How a drape is laid along an outline.
struct GuidedStart {
  int harmonics = 0;   ///< of the profile that are followed
  double kappa = 1;    ///< strength of the guide
  double bending = 1;  ///< factor on the bending stiffnesses of a solve before the one that counts
};

/// The starts in the order they are tried: as asked for, then held more tightly, then bent more
/// gently first.
std::vector<GuidedStart> guided_starts(const std::vector<double>& guide, int harmonics);

/// Whether a profile missed by `rms` [m] is explained: 1.5 standard deviations of a radius. Noise
/// with 31 independent values (15 harmonics) stays below with 99.99 %.
bool explains(double rms, double noise);

/// Whether an estimate is to be preferred to another: by its outcome (a free and converged one to
/// any other), then by the smaller outline_rms.
bool is_better(const Estimate& estimate, const Estimate& than);

}  // namespace drape
