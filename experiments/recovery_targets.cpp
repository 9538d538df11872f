#include "experiments/recovery_targets.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "estimation/random_tags.h"
#include "estimation/tag_model.h"
#include "experiments/dataset_fabrics.h"
#include "experiments/fabric_distribution.h"
#include "experiments/model.h"
#include "experiments/random_fabric.h"

namespace drape {
namespace {

constexpr int kMaxDraws = 500;
constexpr int kTags = 1000;  // enough for every type and fibre of the tables
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

RandomTargets::RandomTargets(const Settings& settings,
                             std::shared_ptr<const Discretization> discretization)
    : settings_(settings), discretization_(std::move(discretization)) {
  if (settings.estimate.distribution == TargetFabrics::tags)
    tags_ = random_tags(kTags, settings.experiment.seed);
}

Record RandomTargets::fabric(Random& random) const {
  Record record;
  switch (settings_.estimate.distribution) {
    case TargetFabrics::box:
      record.fabric = random_fabric(random);
      break;
    case TargetFabrics::measured:
      record.fabric = random_fabric(random, FabricDistribution::measured);
      break;
    case TargetFabrics::tags: {
      const auto which = static_cast<size_t>(random.uniform() * static_cast<double>(tags_.size()));
      const Tag& tag = tags_[which];
      record = tagged(tag, random_parameters(tag, settings_.reading.threshold, random));
      break;
    }
  }
  return record;
}

Record RandomTargets::operator[](int index) const {
  Random random(seed_of_item(settings_.experiment.seed, static_cast<std::uint64_t>(index)));
  const EstimateSettings& estimate = settings_.estimate;
  for (int draw = 0; draw < kMaxDraws; ++draw) {
    const Record drawn = fabric(random);
    if (!within(anisotropy(drawn.fabric), estimate.anisotropy)) continue;
    const Settings chosen = with_protocol(settings_, index, random);
    Potential potential = make_potential(discretization_, drawn.fabric, chosen);
    const Equilibrium target = drape(chosen, potential).equilibrium;
    Record record = make_record(chosen, potential, target);
    copy_tag(drawn, record);
    record.id = record.name = std::to_string(index);
    if (!target.converged() ||
        within(100 * record.observation.drape_coefficient, estimate.drape_coefficient))
      return record;
  }
  throw std::invalid_argument("no fabric of " + std::to_string(kMaxDraws) +
                              " drawn has estimate.anisotropy and estimate.drape_coefficient");
}

}  // namespace drape
