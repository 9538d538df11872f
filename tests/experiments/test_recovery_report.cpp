#include <gtest/gtest.h>

#include "experiments/recovery_report.h"

namespace drape {
namespace {

Record fitted(double drape_coefficient, double factor, const std::string& subcategory,
              const std::string& outcome = "succeeded") {
  Record record;
  record.category = subcategory.empty() ? "" : "Woven";
  record.subcategory = subcategory;
  record.observation.drape_coefficient = drape_coefficient;
  record.estimate.emplace();
  record.estimate->outcome = outcome;
  record.estimate->start = record.fabric;
  record.estimate->fabric = record.fabric;
  for (const Parameter k : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh, Parameter::k_h})
    record.estimate->fabric[k] *= factor;
  record.estimate->outline_rms = 1e-3 * (factor - 1);
  return record;
}

TEST(RecoveryReport, TablesOfErrorsHoldFitsOfEveryOutcome) {
  const std::vector<Record> records{fitted(0.61, 1, "Plain"), fitted(0.69, 1.5, "Plain", "misfit"),
                                    fitted(0.60, 1.3, "Satin", "branch_lost"), fitted(1, 1.01, ""),
                                    Record{}};
  const auto summary = recovery_summary(EstimateSettings{}, records);
  EXPECT_EQ(summary["recovered"], 2);
  const auto& bands = summary["by_drape_coefficient"];
  ASSERT_EQ(bands.size(), 2);
  EXPECT_EQ(bands["60-70"]["fabrics"], 3);
  EXPECT_EQ(bands["60-70"]["succeeded"], 1);
  EXPECT_EQ(bands["60-70"]["recovered"], 1);
  EXPECT_NEAR(bands["60-70"]["median_mean_k_b_error"], 0.3, 1e-12);
  EXPECT_NEAR(bands["60-70"]["median_k_h_error"], 0.3, 1e-12);
  EXPECT_NEAR(bands["60-70"]["median_outline_rms_mm"], 0.3, 1e-12);
  EXPECT_EQ(bands["90-100"]["fabrics"], 1);  // a coefficient of 1 has a band
  const auto& types = summary["by_type"];
  ASSERT_EQ(types.size(), 3);
  EXPECT_EQ(types["Woven, Plain"]["fabrics"], 2);
  EXPECT_EQ(types["Woven, Satin"]["recovered"], 0);
  EXPECT_EQ(types["no tag"]["recovered"], 1);
}

TEST(RecoveryReport, AFailureIsClassifiedByWhatItEndedOn) {
  EstimateSettings settings;
  EXPECT_EQ(recovery_class(fitted(0.6, 1.01, "Plain"), settings), "recovered");
  EXPECT_EQ(recovery_class(fitted(0.6, 1.05, "Plain", "misfit"), settings), "misfit");
  EXPECT_EQ(recovery_class(fitted(0.6, settings.bounds, "Plain", "misfit"), settings), "bounds");
  Record other_nodes = fitted(0.6, 1.05, "Plain");
  other_nodes.estimate->node_count = other_nodes.observation.node_count + 1;
  EXPECT_EQ(recovery_class(other_nodes, settings), "wrong_node_count");
  Record insensitive = fitted(0.6, 1.05, "Plain");
  EXPECT_EQ(recovery_class(insensitive, settings), "neighbouring_branch");
  insensitive.estimate->outline_rms = 0;
  EXPECT_EQ(recovery_class(insensitive, settings), "insensitive");
}

}  // namespace
}  // namespace drape
