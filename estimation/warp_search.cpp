#include "estimation/warp_search.h"

#include <stdexcept>
#include <utility>

namespace drape {
namespace {

/// Less is better: first a fit that ended well, then a higher posterior.
std::pair<int, double> rank(const Estimate& estimate) {
  return std::pair(standing(estimate.outcome), estimate.cost);
}

}  // namespace

WarpSearch estimate_with_warp(std::vector<Picture> pictures, const std::vector<double>& weft_angles,
                              const Fabric& start, const EstimateOptions& options) {
  if (weft_angles.empty())
    throw std::invalid_argument("warp search: no direction of the warp is given");
  WarpSearch search;
  search.pictures = std::move(pictures);
  if (weft_angles.size() == 1)
    for (Picture& picture : search.pictures) picture.seen.weft_angle = weft_angles.front();
  int solves = 0, iterations = 0;
  double cpu_seconds = 0;
  Fabric first = start;
  const size_t all = search.pictures.size();
  for (size_t last = weft_angles.size() == 1 ? all - 1 : 0; last < all; ++last) {
    std::vector<Picture> together(search.pictures.begin(),
                                  search.pictures.begin() + static_cast<std::ptrdiff_t>(last + 1));
    std::optional<Estimate> best;
    for (double angle : weft_angles) {
      together.back().seen.weft_angle = angle;
      Estimate found = estimate(together, first, options);
      const PictureEstimate& drape = found.pictures.back();
      search.trials.push_back(
          {last, angle, found.outcome, found.cost, drape.placement.weft_angle, drape.outline_rms});
      solves += found.forward_solves;
      iterations += found.iterations;
      cpu_seconds += found.cpu_seconds;
      if (best && !(rank(found) < rank(*best))) continue;
      best = std::move(found);
      search.pictures[last].seen.weft_angle = angle;
    }
    search.best = *std::move(best);
    if (search.best.outcome == EstimateOutcome::succeeded) first = search.best.fabric;
  }
  search.best.start = start;
  search.best.forward_solves = solves;
  search.best.iterations = iterations;
  search.best.cpu_seconds = cpu_seconds;
  return search;
}

}  // namespace drape
