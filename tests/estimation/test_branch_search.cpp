#include <gtest/gtest.h>

#include "estimation/branch_search.h"

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
  EXPECT_TRUE(explains(1.49));
  EXPECT_FALSE(explains(1.51));
}

TEST(BranchSearch, OutcomeCountsBeforeMisfit) {
  EXPECT_TRUE(is_better(EstimateOutcome::misfit, 6, EstimateOutcome::branch_lost, 0.2));
  EXPECT_FALSE(is_better(EstimateOutcome::branch_lost, 0.2, EstimateOutcome::misfit, 6));
  EXPECT_TRUE(is_better(EstimateOutcome::misfit, 2, EstimateOutcome::misfit, 6));
  EXPECT_FALSE(is_better(EstimateOutcome::misfit, 6, EstimateOutcome::misfit, 6));
}

}  // namespace
}  // namespace drape::test
