#include <gtest/gtest.h>

#include <stdexcept>

#include "experiments/model.h"

namespace drape {
namespace {

TEST(FillRecord, KeepsWhatTheWorkFilledIn) {
  Record record;
  EXPECT_EQ(fill_record(record, 3, [&] { record.stats.status = "converged"; }), "");
  EXPECT_EQ(record.id, "3");
  EXPECT_EQ(record.name, "3");
  EXPECT_EQ(record.stats.status, "converged");
}

TEST(FillRecord, AnExceptionIsTheStatusOfARecordWithAnId) {
  Record record;
  const auto work = [&] {
    record.fabric.k_u = 7;
    throw std::runtime_error("the outline cannot be traced");
  };
  EXPECT_EQ(fill_record(record, 12, work), "the outline cannot be traced");
  EXPECT_EQ(record.id, "12");
  EXPECT_EQ(record.stats.status, "the outline cannot be traced");
  EXPECT_EQ(record.fabric.k_u, 7);  // so that the failed fabric is on disk
}

}  // namespace
}  // namespace drape
