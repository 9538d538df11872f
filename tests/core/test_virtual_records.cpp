// Tables written record by record, and tables that show those of several files.
#include <gtest/gtest.h>

#include "core/virtual_records.h"
#include "tests/support/records_fixture.h"

namespace drape {
namespace {

using namespace test;

/// Every seventh record from `first` on lies on the support.
Record example(int index, int first, const RecordsHeader& header) {
  Record record = make_record(index, header);
  if (index >= first && index % 7 == 0) {
    record.stats.contact = "support";
    record.contact_force = Uniform(index).vector(3 * header.rest_uv.rows());
  }
  return record;
}

// 150 records are three blocks; contact and estimates begin in the second and the third.
TEST_F(Records, AStreamIsWhatWasStreamed) {
  const auto record = [this](size_t index) {
    Record of = example(static_cast<int>(index), 70, header_);
    if (index == 140) of.estimate = make_estimate(140, header_);
    return of;
  };
  size_t asked = 0;
  write_records(file_, header_, 150, [&](size_t index) {
    EXPECT_EQ(index, asked++);
    return record(index);
  });
  EXPECT_EQ(record_count(file_), 150u);
  const std::vector<Record> all = read_records(file_);
  ASSERT_EQ(all.size(), 150u);
  for (size_t i = 0; i < all.size(); ++i) {
    expect_same(all[i], record(i));
    EXPECT_TRUE(same(all[i].contact_force, record(i).contact_force)) << i;
    EXPECT_EQ(all[i].estimate.has_value(), i == 140) << i;
  }
  const std::vector<Record> some = read_records(file_, 75, 5);
  ASSERT_EQ(some.size(), 5u);
  for (size_t i = 0; i < 5; ++i) expect_same(some[i], record(75 + i));
  EXPECT_THROW(read_records(file_, 146, 5), RecordError);
}

TEST_F(Records, AStreamMayReadOtherFilesAndThrow) {
  write_example(3);
  const fs::path copy = folder_ / "copy.h5";
  write_records(copy, header_, 3, [this](size_t i) { return read_records(file_, i, 1).at(0); });
  expect_same(read_records(copy).at(2), read_records(file_).at(2));
  struct Stop {};
  EXPECT_THROW(write_records(copy, header_, 3, [](size_t) -> Record { throw Stop(); }), Stop);
  EXPECT_EQ(record_count(copy), 3u);  // the former content
}

TEST_F(Records, SeveralFilesAreShownAsOne) {
  std::vector<fs::path> parts;
  std::vector<Record> expected;
  for (int part = 0; part < 3; ++part) {
    parts.push_back(folder_ / ("part" + std::to_string(part) + ".h5"));
    std::vector<Record> records;
    for (int i = 0; i < 2 + part; ++i)
      records.push_back(example(10 * part + i, 20, header_));  // contact in the last one alone
    write_records(parts.back(), header_, records);
    expected.insert(expected.end(), records.begin(), records.end());
  }
  write_virtual_records(file_, header_, parts);
  EXPECT_LT(fs::file_size(file_), 60'000u);
  const auto expect_shown = [&](const fs::path& file) {
    const std::vector<Record> shown = read_records(file);
    ASSERT_EQ(shown.size(), expected.size());
    for (size_t i = 0; i < shown.size(); ++i) {
      expect_same(shown[i], expected[i]);
      EXPECT_TRUE(same(shown[i].contact_force, expected[i].contact_force)) << i;
    }
    EXPECT_EQ(read_header(file).config, header_.config);
  };
  expect_shown(file_);

  // they move together
  fs::create_directory(folder_ / "moved");
  for (const char* name : {"part0.h5", "part1.h5", "part2.h5"})
    fs::rename(folder_ / name, folder_ / "moved" / name);
  EXPECT_THROW(read_records(file_), RecordError);
  const fs::path moved = folder_ / "moved" / "all.h5";
  fs::rename(file_, moved);
  expect_shown(moved);

  fs::remove(folder_ / "moved" / "part1.h5");
  try {
    read_records(moved, 0, 1);
    FAIL() << "a missing file was not noticed";
  } catch (const RecordError& error) {
    EXPECT_NE(std::string(error.what()).find("part1.h5"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace drape
