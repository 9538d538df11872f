#include "experiments/fabric_distribution.h"

#include <cmath>
#include <stdexcept>

#include "core/scene.h"
#include "estimation/bending_rigidity.h"
#include "estimation/measured_bending.h"
#include "experiments/random_fabric.h"

namespace drape {
namespace {

constexpr Interval kStretch{10, 3e4};  // knits to wovens and coated fabrics [N/m]
constexpr Interval kShear{10, 3e3};    // soft knits to coated fabrics [N/m]

constexpr double kShortestBendingLength = 2e-3;  // [m]

Fabric measured_fabric(Random& random) {
  Fabric fabric;
  const MeasuredBending bending = random_bending(random);
  fabric.areal_density = bending.areal_density;
  set_rigidity(fabric, bending.rigidity);
  fabric.k_u = random.log_uniform(kStretch.low, kStretch.high);
  fabric.k_v = random.log_uniform(kStretch.low, kStretch.high);
  fabric.k_h = random.log_uniform(kShear.low, kShear.high);
  set_random_softening(fabric, random);
  return fabric;
}

Fabric wide_fabric(Random& random) {
  FabricBox box;
  box.areal_density = {0.02, 1};
  box.stretch = {5, 1e5};
  box.shear = {1, 1e4};
  box.flexural_rigidity = {1e-8, 1e-2};
  box.anisotropy = {std::sqrt(0.1), std::sqrt(10.0)};
  box.past_threshold = {0.05, 2};
  box.threshold = {0, 1};
  for (;;) {
    const Fabric fabric = random_fabric(random, box);
    if (bending_length(fabric, Scene{}.gravity) >= kShortestBendingLength) return fabric;
  }
}

}  // namespace

std::string_view name(FabricDistribution distribution) {
  return distribution == FabricDistribution::measured ? "measured" : "wide";
}

Fabric random_fabric(Random& random, FabricDistribution distribution) {
  switch (distribution) {
    case FabricDistribution::measured:
      return measured_fabric(random);
    case FabricDistribution::wide:
      return wide_fabric(random);
  }
  throw std::logic_error("a distribution without a function");
}

double bending_length(const Fabric& fabric, double gravity) {
  return std::cbrt(effective_rigidity(fabric).mean() / (fabric.areal_density * gravity));
}

}  // namespace drape
