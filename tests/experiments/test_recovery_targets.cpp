#include "experiments/recovery_targets.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "estimation/fabric_types.h"
#include "experiments/model.h"

namespace drape {
namespace {

Settings small_settings(TargetFabrics distribution) {
  Settings settings;
  settings.mesh.vertices = 300;
  settings.estimate.distribution = distribution;
  settings.estimate.drape_coefficient = {40, 95};
  return settings;
}

TEST(RecoveryTargets, TaggedFabricsAreThoseOfTheTagModelAndDrapeWithinTheRange) {
  const Settings settings = small_settings(TargetFabrics::tags);
  const RandomTargets targets(settings, make_discretization(settings));
  std::set<std::string> types;
  for (int i = 0; i < 4; ++i) {
    const Record target = targets[i];
    ASSERT_EQ(target.stats.status, "converged");
    EXPECT_NE(find_type(target.type), nullptr) << target.type;
    EXPECT_FALSE(target.composition.empty());
    EXPECT_GE(target.observation.drape_coefficient, 0.40);
    EXPECT_LE(target.observation.drape_coefficient, 0.95);
    types.insert(target.type);
  }
  EXPECT_GT(types.size(), 1u);
}

TEST(RecoveryTargets, DependOnSeedAndIndexAlone) {
  for (const TargetFabrics distribution :
       {TargetFabrics::box, TargetFabrics::measured, TargetFabrics::tags}) {
    Settings settings = small_settings(distribution);
    const auto discretization = make_discretization(settings);
    const RandomTargets once(settings, discretization), again(settings, discretization);
    once[0];
    const Record a = once[1], b = again[1];
    EXPECT_EQ(to_vector(a.fabric), to_vector(b.fabric));
    EXPECT_EQ(a.positions, b.positions);
    settings.experiment.seed += 1;
    EXPECT_NE(to_vector(RandomTargets(settings, discretization)[1].fabric), to_vector(a.fabric));
  }
}

TEST(RecoveryTargets, SaysWhenNoFabricHasTheAnisotropyAskedFor) {
  Settings settings = small_settings(TargetFabrics::box);
  settings.estimate.anisotropy = {50, 100};  // the box has at most 4
  const RandomTargets targets(settings, make_discretization(settings));
  EXPECT_THROW(targets[0], std::invalid_argument);
}

}  // namespace
}  // namespace drape
