#include <gtest/gtest.h>

#include "experiments/progress.h"

namespace drape {
namespace {

TEST(Progress, Durations) {
  EXPECT_EQ(duration_text(0.4), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 0 s");
  EXPECT_EQ(duration_text(3599), "59 min 59 s");
  EXPECT_EQ(duration_text(3600), "1 h 0 min");
  EXPECT_EQ(duration_text(90000), "25 h 0 min");
}

TEST(Progress, Lines) {
  EXPECT_EQ(progress_line("drapes", 0, 100, 0, 0), "drapes 0/100 (0 %)");
  EXPECT_EQ(progress_line("drapes", 12, 100, 12, 4), "drapes 12/100 (12 %), 3/s, 29 s left");
  EXPECT_EQ(progress_line("drapes", 12, 100, 12, 30),
            "drapes 12/100 (12 %), 2.5 s each, 3 min 40 s left");
  EXPECT_EQ(progress_line("drapes", 100, 100, 100, 10), "drapes 100/100 (100 %), 10/s, took 10 s");
  EXPECT_EQ(progress_line("drapes", 5000, 9000, 5000, 1),
            "drapes 5000/9000 (55 %), 5000/s, 1 s left");
}

TEST(Progress, PaceIsThatOfThisSession) {
  // 90 of 100 were there before: the ten seconds belong to 5 records, and 5 remain.
  EXPECT_EQ(progress_line("drapes", 95, 100, 5, 10), "drapes 95/100 (95 %), 2 s each, 10 s left");
  EXPECT_EQ(progress_line("drapes", 90, 100, 0, 3), "drapes 90/100 (90 %)");
}

TEST(Progress, NothingToDo) { EXPECT_EQ(progress_line("drapes", 0, 0, 0, 1), "drapes 0/0"); }

}  // namespace
}  // namespace drape
