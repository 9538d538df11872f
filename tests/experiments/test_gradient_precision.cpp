// Gradients by four ways on a small drape, and the gradient on both sides of a snap.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "experiments/gradient_precision.h"
#include "experiments/model.h"
#include "tests/experiments/small_drape.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

Settings small_settings() {
  Settings settings = test::small_drape();
  GradientPrecisionSettings& study = settings.gradient_precision;
  study.parameters = {Parameter::k_h, Parameter::k_bh};
  study.tolerances = {1e-3, 1e-8};
  study.steps = {1e-1, 1e-3};
  study.difference_tolerances = {1e-8};
  study.time_steps = {1};
  study.unrolled_steps = {2, 20};
  study.distances = {1e-2, 1e-4};
  return settings;
}

TEST(GradientPrecision, ErrorsFallWithTheSettings) {
  const Settings settings = small_settings();
  const GradientProblem problem(settings, make_discretization(settings));
  EXPECT_LT(problem.reference_disagreement, 1e-5);
  Progress progress("gradients", gradient_measurements(settings.gradient_precision));
  const Json rows = measure_gradients(problem, progress);
  ASSERT_EQ(static_cast<int>(rows.size()), gradient_measurements(settings.gradient_precision));
  std::map<std::string, std::vector<double>> errors;
  for (const Json& row : rows) {
    ASSERT_EQ(row["status"], "converged") << row.dump();
    EXPECT_GT(row["cpu_seconds"].get<double>(), 0);
    errors[row["method"]].push_back(row["error"].get<double>());
  }
  for (const auto& [method, found] : errors) {
    ASSERT_EQ(found.size(), 2) << method;
    EXPECT_LT(found[1], found[0]) << method;
  }
  EXPECT_LT(errors["adjoint"][1], 1e-6);
  // two routes to one number, from one equilibrium
  EXPECT_NEAR(errors["sensitivities"][1], errors["adjoint"][1], 1e-9);
}

TEST(SnapGradient, GrowsTowardsTheEndOfABranchAndStaysRight) {
  Settings settings = small_settings();
  settings.start.lobes = 6;  // a start whose first snap is no small buckle
  settings.reading.threshold = BendingThreshold::radius;
  settings.fabric.s_bu = settings.fabric.s_bv = settings.fabric.s_bh = 0.6;
  Progress progress("snap", 5);
  const Json snap = gradient_at_snap(settings, make_discretization(settings), progress);
  ASSERT_EQ(snap["status"], "found");
  EXPECT_EQ(snap["end"], "limit_point");
  EXPECT_GE(snap["negative_eigenvalues_beyond"], 1);
  std::map<std::string, std::map<double, Json>> at;
  for (const Json& row : snap["rows"]) {
    ASSERT_EQ(row["status"], "converged") << row.dump();
    at[row["side"]][row["distance"].get<double>()] = row;
  }
  const Json &far = at["before"][1e-2], &near = at["before"][1e-4];
  // both go with the root of the distance: a factor of 10, less what is not yet asymptotic
  EXPECT_GT(near["largest_velocity"].get<double>(), 4 * far["largest_velocity"].get<double>());
  EXPECT_LT(near["smallest_eigenvalue"].get<double>(),
            0.3 * far["smallest_eigenvalue"].get<double>());
  for (const char* side : {"before", "after"})
    for (const auto& [distance, row] : at[side])
      EXPECT_LT(row["adjoint_error"].get<double>(), 1e-2) << side << " " << distance;
  EXPECT_GT(near["differences"][0]["error"].get<double>(), 0.1);  // its step snaps
  EXPECT_NE(snap["adjoint_at_a_saddle"].get<std::string>().find("no converged"), std::string::npos);
}

}  // namespace
}  // namespace drape
