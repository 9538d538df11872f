// What is written is read back, and what cannot be written is refused.
#include <gtest/gtest.h>

#include <thread>

#include "tests/support/records_fixture.h"

namespace drape {
namespace {

using namespace test;

TEST_F(Records, ContactForcesWhereContactActs) {
  std::vector<Record> records{make_record(0, header_), make_record(1, header_)};
  write_records(file_, header_, records);
  EXPECT_FALSE(contains(describe_records(file_), "/sim/contact_force"));
  records[1].stats.contact = "support";
  records[1].contact_force = records[1].positions / 7;
  write_records(file_, header_, records);
  EXPECT_TRUE(contains(describe_records(file_), "/sim/contact_force"));
  const std::vector<Record> kept = read_records(file_);
  expect_same(kept[0], records[0]);
  expect_same(kept[1], records[1]);
  EXPECT_EQ(kept[0].contact_force.size(), 0);
  EXPECT_EQ(read_header(file_).scene.column_radius, header_.scene.column_radius);
}

TEST_F(Records, AFileOfVersionOneLacksWhatIsYounger) {
  Record record = make_record(0, header_);
  record.estimate = make_estimate(0, header_);
  write_records(file_, header_, {record});
  change([](hid_t file) {
    const double one = 1;
    const hid_t version = H5Aopen(file, "version", H5P_DEFAULT);
    ASSERT_GE(H5Awrite(version, H5T_NATIVE_DOUBLE, &one), 0);
    H5Aclose(version);
    ASSERT_GE(H5Adelete(file, "column_radius"), 0);
    for (const std::string group : {"/stats", "/stats_estimated"})
      for (const char* column : {"/contact", "/self_intersections", "/support_penetration"})
        ASSERT_GE(H5Ldelete(file, (group + column).c_str(), H5P_DEFAULT), 0);
    for (const char* younger :
         {"/params_estimated_picture_share", "/estimate/centre", "/estimate/weft_angle",
          "/estimate/log_scale", "/estimate/effective_rigidity",
          "/estimate/effective_rigidity_log_sd"})
      ASSERT_GE(H5Ldelete(file, younger, H5P_DEFAULT), 0);
  });
  for (SolveStats* stats : {&record.stats, &record.estimate->stats}) {
    stats->contact = "off";
    stats->self_intersections = -1;
    stats->support_penetration = kNaN;
  }
  record.estimate->picture_share.setConstant(kNaN);
  record.estimate->centre.setZero();
  record.estimate->weft_angle = record.estimate->log_scale = 0;
  record.estimate->rigidity.setConstant(kNaN);
  record.estimate->rigidity_log_sd.setConstant(kNaN);
  expect_same(read_records(file_).at(0), record);
  EXPECT_EQ(read_header(file_).scene.column_radius, 0);
  EXPECT_TRUE(contains(describe_records(file_), "drape-records 1,"));
}

TEST_F(Records, HeaderRoundTrip) {
  RecordsHeader header = header_;
  header.config += std::string(100'000, '#');  // longer than the 64 KiB of a plain attribute
  write_records(file_, header, {make_record(0, header)});
  const RecordsHeader read = read_header(file_);
  EXPECT_EQ(read.config, header.config);
  EXPECT_EQ(read.seed, header.seed);
  EXPECT_EQ(read.git_commit, header.git_commit);
  EXPECT_EQ(read.compiler, header.compiler);
  EXPECT_EQ(read.mesh_id, header.mesh_id);
  EXPECT_EQ(read.rest_uv, header.rest_uv);
  EXPECT_EQ(read.triangles, header.triangles);
  EXPECT_EQ(read.fixed, header.fixed);
  EXPECT_EQ(read.clamp_wing_factor, header.clamp_wing_factor);
  EXPECT_EQ(read.scene.specimen_radius, header.scene.specimen_radius);
  EXPECT_EQ(read.scene.support_radius, header.scene.support_radius);
  EXPECT_EQ(read.scene.gravity, header.scene.gravity);
  EXPECT_EQ(read.reading.law, header.reading.law);
  EXPECT_EQ(read.reading.threshold, header.reading.threshold);
  EXPECT_EQ(read.grid.rows, header.grid.rows);
  EXPECT_EQ(read.grid.columns, header.grid.columns);
  EXPECT_EQ(read.grid.pixel_size, header.grid.pixel_size);
  EXPECT_EQ(read.grid.origin, header.grid.origin);
}

TEST_F(Records, RoundTripWithAllSomeAndNoEstimates) {
  for (const int estimates : {0, 0b010, 0b111}) {
    std::vector<Record> records;
    for (int i = 0; i < 3; ++i) {
      records.push_back(make_record(i, header_));
      if (estimates >> i & 1) records.back().estimate = make_estimate(i, header_);
    }
    write_records(file_, header_, records);
    const std::vector<Record> read = read_records(file_);
    ASSERT_EQ(read.size(), records.size());
    for (size_t i = 0; i < records.size(); ++i) expect_same(read[i], records[i]);
  }
}

TEST_F(Records, AFailedSolveRoundTrips) {
  Record record = make_record(0, header_);
  record.positions.setConstant(kNaN);
  record.stats = {"line search failed", "folded 7", kNaN, kNaN, 200, 300, 4, 0, kNaN, 1};
  record.observation.profile.setConstant(kNaN);
  record.observation.coverage.setZero();
  record.observation.drape_coefficient = kNaN;
  write_records(file_, header_, {record});
  expect_same(read_records(file_).at(0), record);
}

TEST_F(Records, AnEmptyTableRoundTrips) {
  write_records(file_, header_, {});
  EXPECT_TRUE(read_records(file_).empty());
  EXPECT_EQ(read_header(file_).grid.columns, header_.grid.columns);
}

TEST_F(Records, WrongSizesAndValuesAreRefusedBeforeAnythingIsReplaced) {
  write_example(1);
  const auto refused = [this](const std::function<void(RecordsHeader&, Record&)>& spoil,
                              const std::string& message) {
    RecordsHeader header = header_;
    std::vector<Record> records{make_record(5, header_), make_record(6, header_)};
    records[1].estimate = make_estimate(6, header_);
    spoil(header, records[1]);
    try {
      write_records(file_, header, records);
      ADD_FAILURE() << "accepted: " << message;
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(contains(error.what(), message));
    }
  };
  refused([](auto&, Record& r) { r.positions.resize(20); },
          "record 1: /sim/positions has 20 values, must have 21");
  refused([](auto&, Record& r) { r.observation.profile.resize(36); },
          "/observation/profile has 36 values, must have 360");
  refused([](auto&, Record& r) { r.observation.coverage.setZero(8, 5); },
          "/observation/coverage is [8, 5], must be as the grid, [5, 8]");
  refused([](auto&, Record& r) { r.observation.coverage(1, 1) = 1.001; }, "must be within [0, 1]");
  refused([](auto&, Record& r) { r.observation.coverage(1, 1) = kNaN; }, "must be within [0, 1]");
  refused([](auto&, Record& r) { r.fabric.k_bu = -1; }, "record 1: fabric parameter k_bu = -1");
  refused([](auto&, Record& r) { r.estimate->positions.resize(0); },
          "/sim_estimated/positions has 0 values");
  refused([](auto&, Record& r) { r.estimate->outcome.clear(); },
          "outcome of its estimate is empty");
  refused([](RecordsHeader& h, auto&) { h.fixed.pop_back(); }, "fixed has 6 values: must have 7");
  refused([](RecordsHeader& h, auto&) { h.triangles(2, 1) = 7; }, "must be within 0 to 6");
  refused([](RecordsHeader& h, auto&) { h.rest_uv(0, 0) = kNaN; }, "rest_uv: must be finite");
  refused([](RecordsHeader& h, auto&) { h.mesh_id = "a/b"; }, "mesh id 'a/b'");
  refused([](RecordsHeader& h, auto&) { h.grid.pixel_size = 0; }, "pixel grid");
  refused([](RecordsHeader& h, auto&) { h.scene.gravity = 0; }, "gravity");
  expect_same(read_records(file_).at(0), make_record(0, header_));
  EXPECT_FALSE(fs::exists(file_.string() + ".part"));
}

TEST_F(Records, ThreadsMayWriteAndReadAtTheSameTime) {
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([this, t, &wrong] {
      const fs::path file = folder_ / (std::to_string(t) + ".h5");
      const Record record = make_record(t, header_);
      write_records(file, header_, {record});
      for (int i = 0; i < 25; ++i)
        wrong[static_cast<size_t>(t)] +=
            !same(read_records(file).at(0).positions, record.positions);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST_F(Records, DescriptionShowsColumnsRangesAndShares) {
  std::vector<Record> records;
  for (int i = 0; i < 3; ++i) records.push_back(make_record(i, header_));
  records[0].fabric.k_u = 1500;
  records[1].fabric.k_u = 1200;
  records[2].fabric.k_u = 2750;
  records[2].positions.setConstant(kNaN);
  records[2].stats.status = "failed";
  records[0].estimate = make_estimate(0, header_);
  write_records(file_, header_, records);
  const std::string text = describe_records(file_);
  EXPECT_TRUE(contains(text, "results.h5: 3 records"));
  EXPECT_TRUE(contains(text, "disc_7: 7 vertices, 6 triangles, 1 fixed"));
  EXPECT_TRUE(contains(text, "law secant, threshold radius"));
  EXPECT_TRUE(contains(text, "2 of 3 (66.7 %)"));
  EXPECT_TRUE(contains(text, "\"converged\" x 2, \"failed\" x 1"));
  EXPECT_TRUE(matches(text, "/params/k_u +f64 +\\[3\\] +1200 \\.\\. 2750 N/m\n"));
  EXPECT_TRUE(matches(text, "/sim/positions +f64 +\\[3, 7, 3\\] .*NaN in 1 rows m"));
  EXPECT_TRUE(matches(text, "/observation/coverage +u16 .*0 \\.\\. 65535"));
  EXPECT_THROW(describe_records(folder_ / "missing.h5"), RecordError);
}

// The numbers of 25 profiles are read in three pieces.
TEST_F(Records, RangesAreOverAllRows) {
  std::vector<Record> records;
  for (int i = 0; i < 25; ++i) {
    records.push_back(make_record(i, header_));
    records.back().observation.profile.setConstant(0.125);
  }
  records[0].observation.profile[0] = 0.0625;
  records[12].observation.profile.setConstant(kNaN);
  records[13].observation.profile[359] = kNaN;
  records[24].observation.profile[359] = 0.25;
  write_records(file_, header_, records);
  EXPECT_TRUE(matches(describe_records(file_),
                      "/observation/profile +f64 +\\[25, 360\\] +0.0625 \\.\\. 0.25, NaN in 2 "
                      "rows m\n"));
}

}  // namespace
}  // namespace drape
