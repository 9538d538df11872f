#include "core/settled.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/guided.h"
#include "core/outline.h"
#include "core/profile.h"

namespace drape {
namespace {

constexpr int kHarmonics = 40;  // of an outline that is followed
constexpr double kKappa = 10;   // strength of the first guide

/// The drape that the outline of x leads to.
Equilibrium led_by_outline(const Potential& potential, const Scene& scene, const VecX& x,
                           const EquilibriumOptions& options) {
  const Outline outline = trace_outline(potential.mesh(), scene, x);
  const Guide guide{.radius = harmonics(radial_profile(outline.points).radius, kHarmonics)};
  return drape_guided(potential, scene, guide, {kKappa, kKappa / 10, kKappa / 100}, options);
}

}  // namespace

Equilibrium settle(const Potential& potential, const Scene& scene, Equilibrium drape,
                   const EquilibriumOptions& options, const SettlingOptions& settling) {
  if (!drape.converged()) return drape;
  const std::string protocol = drape.protocol;
  Equilibrium lowest = std::move(drape), work;
  work.add_work_of(lowest);
  std::vector<VecX> passed{lowest.x};
  bool settled = false, circle = false;
  for (int round = 0; round < settling.rounds && !settled && !circle; ++round) {
    Equilibrium next = led_by_outline(potential, scene, passed.back(), options);
    work.add_work_of(next);
    if (!next.converged()) break;
    const auto is_next = [&](const VecX& x) {
      return largest_distance(next.x, x) <= settling.same_distance;
    };
    settled = is_next(passed.back());
    circle = std::any_of(passed.begin(), passed.end() - 1, is_next);
    passed.push_back(next.x);
    if (settled || next.energy < lowest.energy) lowest = std::move(next);
  }
  lowest.set_work_of(work);
  lowest.protocol = protocol + (settled ? ", settled" : ", unsettled");
  return lowest;
}

}  // namespace drape
