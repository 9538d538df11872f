// Tables written to a file of the test's own, and how their readers refuse them.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace drape::test {

/// read: of a file, the function under test.
template <auto read>
class TableFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }

  void write(const std::string& text) const { std::ofstream(file_) << text; }

  void expect_refused(const std::string& text, const std::string& message) const {
    write(text);
    try {
      read(file_);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(file_.string() + message), std::string::npos)
          << error.what();
    }
  }

  const std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) / ("table_" + std::to_string(getpid()) + ".csv");
};

}  // namespace drape::test
