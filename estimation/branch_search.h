// Which branch an outline shows: several guided starts, and what counts as having found it.
//
// A fabric whose membrane is stiff on the mesh has many drapes with nearly the same outline: the
// feet of its folds end in points that the mesh holds in place, and a guided start finds one such
// drape. On the right one a fit explains the outline to its noise; on a neighbour a misfit remains,
// whatever the parameters. Where one remains, the drape is moved: pulled past the outline and let
// go, laid along it again in other ways, or draped anew, with the parameters found so far. A drape
// that a move finds counts if a fit from there explains the outline better.
#pragma once

#include <functional>
#include <vector>

#include "estimation/estimate.h"

namespace drape {

class StagedFit;

/// How a drape is laid along an outline.
struct GuidedStart {
  int harmonics = 0;    ///< of the profile that are followed
  double kappa = 1;     ///< strength of the guide
  double bending = 1;   ///< factor on the bending stiffnesses of a solve before the one that counts
  bool coarse = false;  ///< chosen on the coarse mesh (core/coarse_choice.h)
};

/// The first starts in the order they are tried, until one ends free with the nodes observed: as
/// asked for, then held more tightly, then bent more gently first.
std::vector<GuidedStart> guided_starts(const std::vector<double>& guide, int harmonics);

/// A way from free drapes at hand to other free drapes of the same fabric: false where there are
/// none.
using Move = std::function<bool(StagedFit&)>;

/// The moves in the order they are tried, the cheap ones first.
std::vector<Move> neighbour_moves(int harmonics);

/// Whether an outline whose rms miss is `miss` standard deviations of a radius is explained: up to
/// 1.3. Noise with 31 independent values (15 harmonics), four of them fitted, stays below with
/// 99.8 %.
bool explains(double miss);
/// Whether neighbours need not be tried: up to 1.1, where such noise stays with 91 %.
bool explains_well(double miss);

/// Whether an outcome with its miss is to be preferred to another: the better standing, then the
/// smaller miss.
bool is_better(EstimateOutcome outcome, double miss, EstimateOutcome than, double than_miss);

}  // namespace drape
