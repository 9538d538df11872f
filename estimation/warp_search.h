// Estimation from pictures in which the direction of the warp is not known.
//
// A drape is the same for a fabric turned by half a turn, and a posterior has a maximum for every
// few ways in which the axes of the fabric may lie under the folds. Each picture is tried with
// every given direction, jointly with the pictures before it at their best ones, and the best
// posterior is kept: n pictures with k directions take n k fits and not k^n. Where nothing else
// tells warp from weft, a quarter turn of all pictures that exchanges the two is as good.
#pragma once

#include <vector>

#include "estimation/estimate.h"

namespace drape {

/// One fit of the search.
struct WarpTrial {
  size_t picture;     ///< the last one in the fit
  double weft_angle;  ///< tried for it [rad]
  EstimateOutcome outcome;
  double cost;         ///< see Estimate
  double found_angle;  ///< after the fit [rad]
  double outline_rms;  ///< of that picture [m]
};

struct WarpSearch {
  Estimate best;  ///< from all pictures; its counts and times are those of the whole search
  std::vector<Picture> pictures;  ///< with the directions of its starts
  std::vector<WarpTrial> trials;
};

/// `weft_angles`: directions to try in every picture [rad], in place of OutlineObservation's. One
/// direction is one fit of all pictures. Throws like estimate, and std::invalid_argument without a
/// direction.
WarpSearch estimate_with_warp(std::vector<Picture> pictures, const std::vector<double>& weft_angles,
                              const Fabric& start, const EstimateOptions& options);

}  // namespace drape
