#include "estimation/branch_search.h"

#include <utility>

#include "estimation/staged_fit.h"

namespace drape {
namespace {

constexpr double kExplained = 1.3, kWellExplained = 1.1;  // of the noise
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

std::vector<Move> neighbour_moves(int harmonics) {
  std::vector<Move> moves;
  for (const double factor : {2., 3., 4., 5., 6., 8., 10., 12., 15., 20., 25., 30.})
    moves.emplace_back([factor](StagedFit& fit) { return fit.overshoot(factor); });
  for (const FreeDrape how : {FreeDrape::lobes, FreeDrape::outline})
    moves.emplace_back([how](StagedFit& fit) { return fit.drape_freely(how); });
  const std::vector<GuidedStart> starts{{harmonics, 1, 1},
                                        {harmonics, 1, 1, true},
                                        {harmonics, 1, 3},
                                        {kFineHarmonics, 10, 1, true},
                                        {harmonics, 1, kStiffer, true},
                                        {kFineHarmonics, 100, 1},
                                        {kFineHarmonics, 10, 1},
                                        {harmonics, 0.1, 1},
                                        {harmonics, 1, kStiffer},
                                        {harmonics, 1, 3 * kStiffer}};
  for (const GuidedStart& start : starts)
    moves.emplace_back([start](StagedFit& fit) { return fit.lay_and_release(start); });
  moves.emplace_back([](StagedFit& fit) { return fit.drape_freely(FreeDrape::ramp); });
  return moves;
}

bool explains(double miss) { return miss <= kExplained; }
bool explains_well(double miss) { return miss <= kWellExplained; }

bool is_better(EstimateOutcome outcome, double miss, EstimateOutcome than, double than_miss) {
  return std::pair(standing(outcome), miss) < std::pair(standing(than), than_miss);
}

}  // namespace drape
