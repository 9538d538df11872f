#include <gtest/gtest.h>

#include "estimation/branch_search.h"
#include "estimation/estimate.h"

namespace drape::test {
namespace {

TEST(BranchSearch, TheFirstStartIsTheOneAskedFor) {
  const std::vector<GuidedStart> starts = guided_starts({2, 0.5}, 17);
  ASSERT_GT(starts.size(), 1u);
  EXPECT_EQ(starts.front().harmonics, 17);
  EXPECT_EQ(starts.front().kappa, 2);
  EXPECT_EQ(starts.front().bending, 1);
  for (const GuidedStart& start : starts) EXPECT_GE(start.kappa, 2);
  EXPECT_EQ(guided_starts({}, 24).front().kappa, 1);
}

TEST(BranchSearch, AnOutlineIsExplainedUpToOneAndAHalfStandardDeviations) {
  EXPECT_TRUE(explains(0.74e-3, 0.5e-3));
  EXPECT_FALSE(explains(0.76e-3, 0.5e-3));
}

TEST(BranchSearch, OutcomeCountsBeforeMisfit) {
  Estimate free, guided;
  free.outcome = EstimateOutcome::misfit;
  free.outline_rms = 3e-3;
  guided.outcome = EstimateOutcome::branch_lost;
  guided.outline_rms = 1e-4;
  EXPECT_TRUE(is_better(free, guided));
  EXPECT_FALSE(is_better(guided, free));
  Estimate closer = free;
  closer.outline_rms = 1e-3;
  EXPECT_TRUE(is_better(closer, free));
  EXPECT_FALSE(is_better(free, free));
}

}  // namespace
}  // namespace drape::test
