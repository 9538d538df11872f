#include "estimation/branch_search.h"

#include <tuple>

#include "estimation/estimate.h"

namespace drape {
namespace {

constexpr double kExplained = 1.5;  // of the noise
constexpr int kFineHarmonics = 30;
constexpr double kStiffer = 10;

int rank(EstimateOutcome outcome) {
  switch (outcome) {
    case EstimateOutcome::succeeded:
      return 0;
    case EstimateOutcome::misfit:
      return 1;
    case EstimateOutcome::not_converged:
      return 2;
    case EstimateOutcome::branch_lost:
      return 3;
    case EstimateOutcome::no_start:
      return 4;
  }
  return 5;
}

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

bool explains(double rms, double noise) { return rms <= kExplained * noise; }

bool is_better(const Estimate& estimate, const Estimate& than) {
  return std::tuple(rank(estimate.outcome), estimate.outline_rms) <
         std::tuple(rank(than.outcome), than.outline_rms);
}

}  // namespace drape
