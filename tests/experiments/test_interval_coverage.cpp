#include <gtest/gtest.h>

#include <cmath>

#include "experiments/interval_coverage.h"

namespace drape {
namespace {

Record off_by(double log_miss, double log_sd, const std::string& outcome = "succeeded") {
  Record record;
  record.estimate.emplace();
  record.estimate->outcome = outcome;
  record.estimate->fabric = record.fabric;
  record.estimate->fabric.k_bu *= std::exp(log_miss);
  record.estimate->log_sd.setConstant(log_sd);
  return record;
}

TEST(IntervalCoverage, CountsTheEstimatesThatSucceeded) {
  const std::vector<Record> records{off_by(0.09, 0.1),
                                    off_by(-0.11, 0.1),
                                    off_by(0.21, 0.1),
                                    off_by(-0.15, 0.2),
                                    off_by(9, 0.1, "branch_lost"),
                                    Record{}};
  const std::vector<Parameter> parameters{Parameter::k_bu, Parameter::t_bv};
  const auto one = interval_coverage(records, parameters, k68);
  EXPECT_EQ(one["k_bu"], 0.5);
  EXPECT_EQ(one["t_bv"], 1);
  EXPECT_EQ(interval_coverage(records, parameters, k95)["k_bu"], 0.75);
  EXPECT_TRUE(std::isnan(interval_coverage({}, parameters, k95)["k_bu"].get<double>()));
}

}  // namespace
}  // namespace drape
