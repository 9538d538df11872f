// How tables of made-up records are compared, and a folder for each test.
#pragma once

#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/made_up_records.h"

namespace drape::test {

namespace fs = std::filesystem;

/// Coverage is stored in steps of 1/65535; rounding is off by half of one.
inline constexpr double kCoverageTolerance = 0.5 / 65535 + 1e-12;

/// Equal bit by bit, or NaN in the same places.
inline bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }
inline bool same(const VecX& a, const VecX& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return same(x, y); });
}
inline bool same(const Fabric& a, const Fabric& b) { return to_vector(a) == to_vector(b); }
inline bool same(const SolveStats& a, const SolveStats& b) {
  return a.status == b.status && a.protocol == b.protocol &&
         same(a.residual_relative, b.residual_relative) &&
         same(a.rounding_floor, b.rounding_floor) && a.newton_iterations == b.newton_iterations &&
         a.factorizations == b.factorizations && a.negative_eigenvalues == b.negative_eigenvalues &&
         a.wings_past_threshold == b.wings_past_threshold && same(a.energy, b.energy) &&
         same(a.cpu_seconds, b.cpu_seconds) && a.contact == b.contact &&
         a.self_intersections == b.self_intersections &&
         same(a.support_penetration, b.support_penetration);
}

inline void expect_same(const EstimateRecord& a, const EstimateRecord& b) {
  EXPECT_TRUE(same(a.fabric, b.fabric));
  EXPECT_TRUE(same(a.start, b.start));
  EXPECT_TRUE(same(VecX(a.log_sd), VecX(b.log_sd)));
  EXPECT_TRUE(same(a.positions, b.positions));
  EXPECT_TRUE(same(a.stats, b.stats));
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.branch_shared, b.branch_shared);
  EXPECT_EQ(a.outline_rms, b.outline_rms);
  EXPECT_EQ(a.iou, b.iou);
  EXPECT_EQ(a.drape_coefficient, b.drape_coefficient);
  EXPECT_EQ(a.node_count, b.node_count);
  EXPECT_EQ(a.forward_solves, b.forward_solves);
  EXPECT_TRUE(same(a.profile, b.profile));
  EXPECT_TRUE(same(a.start_profile, b.start_profile));
  EXPECT_TRUE(same(VecX(a.picture_share), VecX(b.picture_share)));
  EXPECT_TRUE(same(a.centre, b.centre));
  EXPECT_EQ(a.weft_angle, b.weft_angle);
  EXPECT_EQ(a.log_scale, b.log_scale);
  EXPECT_TRUE(same(a.rigidity, b.rigidity));
  EXPECT_TRUE(same(a.rigidity_log_sd, b.rigidity_log_sd));
}

inline void expect_same(const Record& a, const Record& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.category, b.category);
  EXPECT_EQ(a.subcategory, b.subcategory);
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.composition, b.composition);
  EXPECT_TRUE(same(a.fabric, b.fabric));
  EXPECT_TRUE(same(a.positions, b.positions));
  EXPECT_TRUE(same(a.contact_force, b.contact_force));
  EXPECT_TRUE(same(a.stats, b.stats));
  EXPECT_TRUE(same(a.observation.profile, b.observation.profile));
  ASSERT_EQ(a.observation.coverage.rows(), b.observation.coverage.rows());
  ASSERT_EQ(a.observation.coverage.cols(), b.observation.coverage.cols());
  EXPECT_LE((a.observation.coverage - b.observation.coverage).cwiseAbs().maxCoeff(),
            kCoverageTolerance);
  EXPECT_TRUE(same(a.observation.drape_coefficient, b.observation.drape_coefficient));
  EXPECT_EQ(a.observation.node_count, b.observation.node_count);
  ASSERT_EQ(a.estimate.has_value(), b.estimate.has_value());
  if (a.estimate) expect_same(*a.estimate, *b.estimate);
}

inline ::testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\"" << part << "\" is not in:\n" << text;
}

inline ::testing::AssertionResult matches(const std::string& text, const std::string& pattern) {
  if (std::regex_search(text, std::regex(pattern))) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\"" << pattern << "\" does not match:\n" << text;
}

class Records : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  void write_example(int count = 2) const {
    std::vector<Record> records;
    for (int i = 0; i < count; ++i) records.push_back(make_record(i, header_));
    write_records(file_, header_, records);
  }

  /// Changes the file behind the back of the library.
  void change(const std::function<void(hid_t)>& edit) const {
    const hid_t file = H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    edit(file);
    ASSERT_GE(H5Fclose(file), 0);
  }

  /// The message of the RecordError of reading everything; empty if none is thrown.
  std::string error() const {
    try {
      read_records(file_);
    } catch (const RecordError& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder_ = fs::path(::testing::TempDir()) /
                           ("drape_records_" + std::to_string(getpid()) + "_" +
                            ::testing::UnitTest::GetInstance()->current_test_info()->name());
  const fs::path file_ = folder_ / "results.h5";
  const RecordsHeader header_ = make_header();
};

/// What `action` returns in a child process, for what leaves the library in a poor state: HDF5
/// loses memory when it refuses a damaged header, and keeps a file open that it could not write.
inline bool holds_in_child(const std::function<bool()>& action) {
  const pid_t child = fork();
  if (child == 0) {
    bool holds = false;
    try {
      holds = action();
    } catch (...) {
    }
    _exit(holds ? 0 : 1);
  }
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace drape::test
