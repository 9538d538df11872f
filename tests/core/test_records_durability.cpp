// A full disk and a killed process lose no record that was acknowledged.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tests/support/records_fixture.h"

namespace drape {
namespace {

using namespace test;

TEST_F(Records, ADiskThatRefusesIsARecordErrorAndKeepsTheOldFile) {
  EXPECT_THROW(write_records(folder_ / "missing" / "a.h5", header_, {}), RecordError);
  write_example(1);
  EXPECT_TRUE(holds_in_child([this] {
    // A limit on the size of files stands in for a full disk: write() then fails in the same way.
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{20'000, 20'000};
    setrlimit(RLIMIT_FSIZE, &small);
    try {
      write_example(3);
    } catch (const RecordError&) {
      return true;
    }
    return false;
  }));
  expect_same(read_records(file_).at(0), make_record(0, header_));
  EXPECT_FALSE(fs::exists(file_.string() + ".part"));
}

// A child writes records under two names in turn, each name many times, and acknowledges every
// record by a byte. Whenever it is killed, each name must hold a complete record that is at least
// as new as the last acknowledged one of that name.
TEST_F(Records, AKillLosesNoAcknowledgedRecord) {
  constexpr int kTrials = 20;
  constexpr int kNames = 2;
  const auto name_of = [this](int index) {
    return folder_ / (std::to_string(index % kNames) + ".h5");
  };
  Uniform uniform(2024);
  for (int trial = 0; trial < kTrials; ++trial) {
    int channel[2];
    ASSERT_EQ(pipe(channel), 0);
    const pid_t child = fork();
    if (child == 0) {
      for (int i = 0;; ++i) {
        write_records(name_of(i), header_, {make_record(i, header_)});
        if (write(channel[1], "x", 1) != 1) _exit(1);
      }
    }
    close(channel[1]);
    // The child is killed somewhere after its first or second record.
    char byte = 0;
    int acknowledged = 0;
    while (acknowledged < 1 + trial % 2 && read(channel[0], &byte, 1) == 1) ++acknowledged;
    std::this_thread::sleep_for(std::chrono::microseconds(static_cast<int>(1e4 * uniform())));
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the child ended by itself";
    while (read(channel[0], &byte, 1) == 1) ++acknowledged;
    close(channel[0]);
    ASSERT_GT(acknowledged, trial % 2);

    for (int slot = 0; slot < kNames; ++slot) {
      if (!fs::exists(name_of(slot))) {
        EXPECT_GE(slot, acknowledged) << "an acknowledged record is gone";
        continue;
      }
      const std::vector<Record> read = read_records(name_of(slot));
      ASSERT_EQ(read.size(), 1u);
      const int index = std::stoi(read[0].id);
      expect_same(read[0], make_record(index, header_));
      EXPECT_GT(index + kNames, acknowledged - 1)
          << "an acknowledged record was replaced by an older";
      EXPECT_LE(index, acknowledged);  // at most one record can be on its way
      fs::remove(name_of(slot));
    }
  }
}

}  // namespace
}  // namespace drape
