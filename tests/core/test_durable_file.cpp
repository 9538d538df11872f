#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "core/durable_file.h"

namespace drape {
namespace {

namespace fs = std::filesystem;

class DurableFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  const fs::path folder_ = fs::path(::testing::TempDir()) /
                           ("drape_durable_" + std::to_string(getpid()) + "_" +
                            ::testing::UnitTest::GetInstance()->current_test_info()->name());
  const fs::path file_ = folder_ / "summary.json";
  const fs::path part_ = folder_ / "summary.json.part";
};

TEST_F(DurableFile, HoldsTheTextByteForByte) {
  const std::string text("two\r\nlines\0and a zero", 21);
  write_text_durably(file_, text);
  EXPECT_EQ(content(file_), text);
  EXPECT_FALSE(fs::exists(part_));
}

TEST_F(DurableFile, ReplacesAnOlderFileAndAPartLeftBehind) {
  write_text_durably(file_, "a long first version");
  std::ofstream(part_) << "what a killed process left behind, longer than the new content";
  write_text_durably(file_, "new");
  EXPECT_EQ(content(file_), "new");
  EXPECT_FALSE(fs::exists(part_));
}

TEST_F(DurableFile, FinalNameAppearsOnlyAfterTheWriter) {
  write_durably(file_, [this](const fs::path& part) {
    EXPECT_EQ(part, part_);
    std::ofstream(part) << "content";
    EXPECT_FALSE(fs::exists(file_));
  });
  EXPECT_EQ(content(file_), "content");
}

TEST_F(DurableFile, KeepsTheOlderFileWhenTheWriterThrows) {
  write_text_durably(file_, "old");
  const auto fail = [](const fs::path& part) {
    std::ofstream(part) << "half";
    throw std::runtime_error("stopped");
  };
  EXPECT_THROW(write_durably(file_, fail), std::runtime_error);
  EXPECT_EQ(content(file_), "old");
  EXPECT_FALSE(fs::exists(part_));
}

TEST_F(DurableFile, KeepsTheOlderFileWhenTheDiskIsFull) {
  write_text_durably(file_, "old");
  // A limit on the size of files stands in for a full disk: write() then fails in the same way.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(write_text_durably(file_, std::string(5000, 'x')), fs::filesystem_error);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(content(file_), "old");
  EXPECT_FALSE(fs::exists(part_));
}

TEST_F(DurableFile, RefusesAMissingFolderAndANameThatIsAFolder) {
  EXPECT_THROW(write_text_durably(folder_ / "missing" / "file", "text"), fs::filesystem_error);
  fs::create_directory(file_);
  EXPECT_THROW(write_text_durably(file_, "text"), fs::filesystem_error);
  EXPECT_FALSE(fs::exists(part_));
}

TEST_F(DurableFile, TakesANameWithoutFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  EXPECT_NO_THROW(write_text_durably("plain.txt", "text"));
  fs::current_path(before);
  EXPECT_EQ(content(folder_ / "plain.txt"), "text");
}

}  // namespace
}  // namespace drape
