#include "experiments/recovery_targets.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/random.h"
#include "experiments/fabric_distribution.h"
#include "experiments/model.h"
#include "experiments/random_fabric.h"

namespace drape {
namespace {

constexpr int kMaxDraws = 500;
constexpr double kPi = 3.14159265358979323846;

bool within(double value, const std::vector<double>& range) {
  return value >= range[0] && value <= range[1];
}

double anisotropy(const Fabric& fabric) {
  const auto [least, most] = std::minmax({fabric.k_bu, fabric.k_bv, fabric.k_bh});
  return most / least;
}

/// The settings with the protocol whose turn it is.
Settings with_protocol(const Settings& settings, int index, Random& random) {
  Settings chosen = settings;
  const EstimateSettings& estimate = settings.estimate;
  if (estimate.protocols.empty()) return chosen;
  chosen.start.protocol =
      estimate.protocols[static_cast<size_t>(index) % estimate.protocols.size()];
  if (chosen.start.protocol != StartProtocol::lobes) return chosen;
  const auto which =
      static_cast<size_t>(random.uniform() * static_cast<double>(estimate.lobes.size()));
  chosen.start.lobes = estimate.lobes[which];
  chosen.start.phase = random.uniform(0, 2 * kPi / chosen.start.lobes);
  return chosen;
}

}  // namespace

Record random_target(const Settings& settings, std::shared_ptr<const Discretization> discretization,
                     int index) {
  Random random(seed_of_item(settings.experiment.seed, static_cast<std::uint64_t>(index)));
  const EstimateSettings& estimate = settings.estimate;
  for (int draw = 0; draw < kMaxDraws; ++draw) {
    const Fabric fabric = estimate.distribution == TargetFabrics::measured
                              ? random_fabric(random, FabricDistribution::measured)
                              : random_fabric(random);
    if (!within(anisotropy(fabric), estimate.anisotropy)) continue;
    const Settings chosen = with_protocol(settings, index, random);
    Potential potential = make_potential(discretization, fabric, chosen);
    const Equilibrium target = drape(chosen, potential).equilibrium;
    Record record = make_record(chosen, potential, target);
    record.id = record.name = std::to_string(index);
    if (!target.converged() ||
        within(100 * record.observation.drape_coefficient, estimate.drape_coefficient))
      return record;
  }
  throw std::invalid_argument("no fabric of " + std::to_string(kMaxDraws) +
                              " drawn has estimate.anisotropy and estimate.drape_coefficient");
}

}  // namespace drape
