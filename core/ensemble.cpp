#include "core/ensemble.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/drape_protocol.h"
#include "core/profile.h"
#include "core/random.h"

namespace drape {
namespace {

constexpr double kFlatNoise = 1e-4;  // of a flat start [m]

bool is_isotropic(const Fabric& f) {
  return f.k_u == f.k_v && f.k_bu == f.k_bv && f.k_bu == f.k_bh && f.s_bu == f.s_bv &&
         f.s_bu == f.s_bh && f.t_bu == f.t_bv && f.t_bu == f.t_bh;
}

/// Whether two profiles agree after a turn by a multiple of `turn` degrees, mirrored or not.
bool same_shape(const VecX& a, const VecX& b, int turn, double rms) {
  for (int shift = 0; shift < kProfileSize; shift += turn)
    for (int sign : {1, -1}) {
      double sum = 0;
      for (int i = 0; i < kProfileSize; ++i) {
        const double miss = a[i] - b[(shift + sign * i + kProfileSize) % kProfileSize];
        sum += miss * miss;
      }
      if (sum <= rms * rms * kProfileSize) return true;
    }
  return false;
}

}  // namespace

std::string EnsembleStart::name() const {
  std::ostringstream text;
  if (kind == Kind::lobes)
    text << "lobes(" << lobes << ", " << phase << ")";
  else
    text << (kind == Kind::ramp ? "coarse_ramp" : "flat") << "(seed " << seed << ")";
  return text.str();
}

std::vector<EnsembleStart> ensemble_starts(const EnsembleOptions& options) {
  std::vector<EnsembleStart> starts;
  for (int i = 0; i < options.ramps; ++i)
    starts.push_back(
        {.kind = EnsembleStart::Kind::ramp, .seed = options.seed + static_cast<std::uint64_t>(i)});
  for (int lobes = options.fewest_lobes; lobes <= options.most_lobes; ++lobes)
    for (int i = 0; i < options.phases; ++i)
      starts.push_back({.kind = EnsembleStart::Kind::lobes,
                        .lobes = lobes,
                        .phase = 2 * std::numbers::pi * i / (lobes * options.phases)});
  for (int i = 0; i < options.flats; ++i)
    starts.push_back(
        {.kind = EnsembleStart::Kind::flat, .seed = options.seed + static_cast<std::uint64_t>(i)});
  if (starts.empty()) throw std::invalid_argument("ensemble: no start is left");
  return starts;
}

Equilibrium drape_from(const Potential& potential, const Scene& scene, const EnsembleStart& start,
                       const EquilibriumOptions& options) {
  Equilibrium result;
  switch (start.kind) {
    case EnsembleStart::Kind::ramp:
      result = drape_by_coarse_ramp(potential, start.seed, options);
      break;
    case EnsembleStart::Kind::lobes:
      result = drape_by_lobes(potential, scene, start.lobes, start.phase, options);
      break;
    case EnsembleStart::Kind::flat: {
      VecX x = flat_state(potential.mesh());
      Random random(start.seed);
      for (int v : potential.discretization().free_vertices())
        for (int k = 0; k < 3; ++k) x[3 * v + k] += kFlatNoise * random.uniform(-1, 1);
      result = solve_equilibrium(potential, x, options);
      break;
    }
  }
  result.protocol = start.name();
  return result;
}

Equilibrium lowest_of_ensemble(const Potential& potential, const Scene& scene,
                               const EnsembleOptions& ensemble, const EquilibriumOptions& options) {
  Equilibrium lowest, work;
  for (const EnsembleStart& start : ensemble_starts(ensemble)) {
    Equilibrium drape = drape_from(potential, scene, start, options);
    work.add_work_of(drape);
    if (!lowest.converged() || (drape.converged() && drape.energy < lowest.energy))
      lowest = std::move(drape);
  }
  lowest.set_work_of(work);
  lowest.protocol = "ensemble, " + lowest.protocol;
  return lowest;
}

std::vector<MinimumGroup> merge_minima(const std::vector<VecX>& states,
                                       const std::vector<double>& energies, double distance) {
  if (states.size() != energies.size())
    throw std::invalid_argument("merge_minima: " + std::to_string(states.size()) + " states, " +
                                std::to_string(energies.size()) + " energies");
  std::vector<size_t> order(states.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, [&](size_t a, size_t b) { return energies[a] < energies[b]; });
  std::vector<MinimumGroup> groups;
  for (size_t i : order) {
    const auto known = std::ranges::find_if(groups, [&](const MinimumGroup& group) {
      return largest_distance(states[group.representative], states[i]) <= distance;
    });
    if (known == groups.end())
      groups.push_back({i, {i}});
    else
      known->members.push_back(i);
  }
  return groups;
}

int distinct_shapes(const std::vector<VecX>& profiles, const Fabric& fabric, double rms) {
  const int turn = is_isotropic(fabric) ? 1 : 180;
  std::vector<const VecX*> shapes;
  for (const VecX& profile : profiles)
    if (std::ranges::none_of(
            shapes, [&](const VecX* known) { return same_shape(*known, profile, turn, rms); }))
      shapes.push_back(&profile);
  return static_cast<int>(shapes.size());
}

}  // namespace drape
