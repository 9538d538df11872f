#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "experiments/robustness_report.h"
#include "experiments/summary.h"

namespace drape {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

RobustnessSolve good(int index) {
  RobustnessSolve solve;
  solve.index = index;
  solve.seed = 0xfedcba9876543210;  // needs all of its 64 bits
  solve.distribution = index % 2 == 0 ? "measured" : "wide";
  solve.size = 2000;
  solve.bending_length = 0.02;
  solve.residual = 2e-9;
  solve.rounding_floor = 1e-9;
  solve.negative_eigenvalues = 0;
  solve.newton_iterations = 30;
  solve.factorizations = 12 + index;
  solve.wings_past_threshold = 7;
  solve.contact_with_support = index % 2 == 1;
  solve.self_intersections = 2 * index;
  solve.cpu_seconds = 0.2;
  solve.unit_cpu_seconds = 0.01;
  return solve;
}

RobustnessSolve thrown(int index) {
  RobustnessSolve solve = good(index);
  solve.failure = "exception";
  solve.reason = "the outline cannot be traced";
  solve.residual = solve.rounding_floor = solve.cpu_seconds = solve.unit_cpu_seconds = kNaN;
  solve.negative_eigenvalues = -1;
  solve.contact_with_support = false;
  solve.self_intersections = -1;
  return solve;
}

TEST(RobustnessReport, FailuresHaveAClass) {
  RobustnessSolve solve = good(0);
  EXPECT_EQ(failure_class(solve, "converged", true), "");
  EXPECT_EQ(failure_class(solve, "stagnated", true), "stagnated");
  EXPECT_EQ(failure_class(solve, "converged", false), "non_finite");
  solve.negative_eigenvalues = 1;
  EXPECT_EQ(failure_class(solve, "converged", true), "not_certified");
  solve = good(0);
  solve.residual = 1.01e-8;
  EXPECT_EQ(failure_class(solve, "converged", true), "residual_above_target");
  solve.rounding_floor = 1.02e-8;  // nothing below can be asked for
  EXPECT_EQ(failure_class(solve, "converged", true), "");
  solve.residual = kNaN;
  EXPECT_EQ(failure_class(solve, "converged", true), "non_finite");
}

TEST(RobustnessReport, CountsAndPercentilesWithoutNaN) {
  const auto summary = account({good(0), good(1), thrown(2)});
  EXPECT_EQ(summary["fabrics"], 3);
  EXPECT_EQ(summary["converged"], 2);
  EXPECT_EQ(summary["certified_minima"], 2);
  EXPECT_EQ(summary["contact_with_support"], 1);
  EXPECT_EQ(summary["self_intersecting"], 1);
  EXPECT_EQ(summary["worst_residual"], 2e-9);
  EXPECT_NEAR(summary["worst_residual_over_target"].get<double>(), 0.2, 1e-12);  // rounding
  EXPECT_NEAR(summary["factorization_equivalents_percentiles"]["50"].get<double>(), 20, 1e-9);
  EXPECT_NEAR(summary["milliseconds_percentiles"]["100"].get<double>(), 200, 1e-9);
  EXPECT_EQ(summary["unit_milliseconds_median"], 10);
  EXPECT_EQ(summary["failure_classes"]["exception"], 1);
  for (const auto& nothing : {account({}), account({thrown(0)})}) {
    EXPECT_TRUE(nothing["worst_residual"].is_null());
    EXPECT_TRUE(nothing["cpu_seconds_percentiles"]["95"].is_null());
    EXPECT_FALSE(table_row("none", nothing).empty());
  }
}

TEST(RobustnessReport, AFailureNamesTheCommandThatReplaysIt) {
  const auto list = failures({good(0), thrown(17)}, "it's/run");
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0]["index"], 17);
  EXPECT_EQ(list[0]["seed"], 0xfedcba9876543210);
  EXPECT_EQ(list[0]["distribution"], "wide");
  EXPECT_EQ(list[0]["class"], "exception");
  EXPECT_TRUE(list[0]["residual"].is_null());
  EXPECT_EQ(list[0]["replay"],
            "drape run 'it'\\''s/run/config.toml' --out 'it'\\''s/run/replay_2000_17' "
            "--set 'robustness.only=[17]' --set 'robustness.vertices=[2000]'");
}

TEST(RobustnessReport, SolvesSurviveTheDisk) {
  for (const RobustnessSolve& solve : {good(1), thrown(2)}) {
    const std::string text = summary_text(to_json(solve));
    EXPECT_EQ(text, summary_text(to_json(robustness_solve(nlohmann::ordered_json::parse(text)))));
  }
}

TEST(RobustnessReport, TheTableHasEmptyCellsForWhatIsNotKnown) {
  const std::string text = csv({good(0), thrown(1)});
  const std::string second = text.substr(text.find("\n1,") + 1);
  EXPECT_EQ(second, "1,wide,2000,0.02,,,30,13,7,,,exception\n");
}

}  // namespace
}  // namespace drape
