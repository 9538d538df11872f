#include "estimation/branch_search.h"

#include <tuple>

namespace drape {
namespace {

constexpr double kExplained = 1.5;  // of the noise
constexpr int kFineHarmonics = 30;
constexpr double kStiffer = 10;

}  // namespace

std::vector<GuidedStart> guided_starts(const std::vector<double>& guide, int harmonics) {
  const double kappa = guide.empty() ? 1 : guide.front();
  return {{harmonics, kappa, 1},
          {kFineHarmonics, 10 * kappa, 1},
          {kFineHarmonics, 100 * kappa, 1},
          {harmonics, kappa, kStiffer},
          {kFineHarmonics, 10 * kappa, kStiffer},
          {harmonics, kappa, 1},
          {kFineHarmonics, 100 * kappa, kStiffer},
          {kFineHarmonics, 10 * kappa, 1}};
}

bool explains(double miss) { return miss <= kExplained; }

bool is_better(EstimateOutcome outcome, double miss, EstimateOutcome than, double than_miss) {
  return std::tuple(outcome, miss) < std::tuple(than, than_miss);
}

}  // namespace drape
