// Predictions without a branch, on made-up drapes: the protocol comes from the other fabrics.
#include "experiments/branch_free_prediction.h"

#include <gtest/gtest.h>

#include <string>

#include "experiments/json_store.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

Json drape(const std::string& protocol, double coefficient, int nodes) {
  return {
      {"protocol", protocol}, {"drape_coefficient_percent", coefficient}, {"node_count", nodes}};
}

/// Photographs of 60 +- 1 % and 8 nodes.
DrapedByProtocols fabric(const Json& drapes) { return {drapes, {59, 60, 61}, {8, 8, 7}}; }

TEST(BranchFreePrediction, TakesTheProtocolThatIsBestOnTheOtherFabrics) {
  // on fabrics 0 and 1 "near" is better, on fabric 2 alone "far" is
  const auto found = predict_without_branch({fabric({drape("far", 50, 4), drape("near", 61, 7)}),
                                             fabric({drape("far", 40, 4), drape("near", 58, 9)}),
                                             fabric({drape("far", 60, 8), drape("near", 67, 6)})});
  ASSERT_EQ(found.fabrics.size(), 3);
  for (const Json& row : found.fabrics) EXPECT_EQ(row["protocol"], "near");
  EXPECT_EQ(number(found.fabrics[0]["drape_coefficient_error"]), 1);
  EXPECT_EQ(number(found.fabrics[1]["node_error"]), 1);
  EXPECT_EQ(number(found.fabrics[2]["drape_coefficient_error"]), 7);  // its own best is not known
  EXPECT_EQ(found.fabrics[2]["node_counts"], Json({8, 6}));
  EXPECT_EQ(number(found.summary["drape_coefficient_error_median"]), 2);
  EXPECT_EQ(number(found.summary["drape_coefficient_sd_of_photographs_median"]), 1);
  const Json& far = found.summary["by_protocol"]["far"];
  EXPECT_EQ(far["fabrics"], 3);
  EXPECT_EQ(number(far["drape_coefficient_error_median"]), 10);
  EXPECT_EQ(number(far["drape_coefficient_bias_median"]), -10);
  EXPECT_EQ(number(far["node_bias_median"]), -4);
}

TEST(BranchFreePrediction, AFabricDoesNotChooseItsOwnProtocol) {
  const auto found = predict_without_branch({fabric({drape("a", 60, 8), drape("b", 50, 8)}),
                                             fabric({drape("a", 50, 8), drape("b", 60, 8)})});
  EXPECT_EQ(found.fabrics[0]["protocol"], "b");
  EXPECT_EQ(found.fabrics[1]["protocol"], "a");
}

TEST(BranchFreePrediction, PassesOverDrapesThatFailed) {
  const Json failed = {{"protocol", "near"}, {"status", "stagnated"}};
  const auto found = predict_without_branch(
      {fabric({drape("far", 50, 4), failed}), fabric({drape("far", 52, 4), drape("near", 60, 8)}),
       fabric({drape("far", 51, 4), drape("near", 60, 8)}), fabric(Json::array({failed}))});
  EXPECT_EQ(found.fabrics[0]["protocol"], "far");
  EXPECT_EQ(found.fabrics[1]["protocol"], "near");
  EXPECT_TRUE(found.fabrics[3].is_null());
  EXPECT_EQ(found.summary["fabrics"], 3);
  EXPECT_EQ(found.summary["by_protocol"]["near"]["fabrics"], 2);
}

TEST(BranchFreePrediction, OneFabricIsPredictedByItsFirstDrape) {
  const auto found = predict_without_branch({fabric({drape("a", 50, 4), drape("b", 60, 8)})});
  EXPECT_EQ(found.fabrics[0]["protocol"], "a");
  EXPECT_TRUE(predict_without_branch({}).fabrics.empty());
}

}  // namespace
}  // namespace drape
