#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "core/ensemble.h"
#include "core/profile.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

TEST(Ensemble, StartsAreCountedAndNamed) {
  const std::vector<EnsembleStart> starts = ensemble_starts({});
  EXPECT_EQ(starts.size(), 3u + 7u * 3u + 5u);
  std::set<std::string> names;
  for (const EnsembleStart& start : starts) names.insert(start.name());
  EXPECT_EQ(names.size(), starts.size());
  EXPECT_TRUE(names.contains("coarse_ramp(seed 1)"));
  EXPECT_TRUE(names.contains("lobes(3, 0)"));
  EXPECT_TRUE(names.contains("flat(seed 5)"));
  EXPECT_THROW(ensemble_starts({.ramps = 0, .phases = 0, .flats = 0}), std::invalid_argument);
}

TEST(Ensemble, MergesEqualStatesAndSortsByEnergy) {
  const VecX a = VecX::Zero(6);
  VecX near_a = a, far = a;
  near_a[4] = 0.9e-4;
  far[4] = 1.1e-4;
  const auto groups = merge_minima({far, near_a, a}, {3, 2, 1}, 1e-4);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].representative, 2u);
  EXPECT_EQ(groups[0].members, (std::vector<size_t>{2, 1}));
  EXPECT_EQ(groups[1].members, (std::vector<size_t>{0}));
  EXPECT_TRUE(merge_minima({}, {}, 1e-4).empty());
  EXPECT_THROW(merge_minima({a}, {}, 1e-4), std::invalid_argument);
}

TEST(Ensemble, TurnedAndMirroredShapesAreTwins) {
  VecX profile(kProfileSize), turned(kProfileSize), mirrored(kProfileSize);
  const auto radius = [](double degrees) {
    const double a = degrees * M_PI / 180;
    return 0.12 + 0.01 * std::cos(3 * a) + 0.006 * std::sin(4 * a + 0.5);
  };
  for (int i = 0; i < kProfileSize; ++i) {
    profile[i] = radius(i);
    turned[i] = radius(i + 37);
    mirrored[i] = radius(-i);
  }
  Fabric isotropic, woven;
  woven.k_bu = 2 * woven.k_bv;
  EXPECT_EQ(distinct_shapes({profile, turned, mirrored}, isotropic), 1);
  EXPECT_EQ(distinct_shapes({profile, turned, mirrored}, woven), 2);  // the mirror is allowed
  EXPECT_EQ(distinct_shapes({profile, VecX(profile.array() + 1e-3)}, isotropic), 2);
}

TEST(Ensemble, FindsWhatItsStartsFind) {
  const Potential potential(disc(250), stiff_fabric(), {}, kCusick.gravity);
  const EnsembleOptions options{
      .ramps = 0, .fewest_lobes = 3, .most_lobes = 4, .phases = 1, .flats = 1};
  std::vector<VecX> states;
  std::vector<double> energies;
  for (const EnsembleStart& start : ensemble_starts(options)) {
    const Equilibrium drape = drape_from(potential, kCusick, start);
    ASSERT_TRUE(drape.converged()) << start.name();
    EXPECT_EQ(drape.protocol, start.name());
    states.push_back(drape.x);
    energies.push_back(drape.energy);
  }
  const auto groups = merge_minima(states, energies, options.same_distance);
  for (const VecX& state : states) {
    int home = 0;
    for (const MinimumGroup& group : groups)
      home += largest_distance(states[group.representative], state) <= options.same_distance;
    EXPECT_EQ(home, 1);
  }
  const Equilibrium lowest = lowest_of_ensemble(potential, kCusick, options);
  EXPECT_EQ(lowest.energy, energies[groups.front().representative]);
  EXPECT_TRUE(lowest.protocol.starts_with("ensemble, ")) << lowest.protocol;
}

}  // namespace
}  // namespace drape::test
