#include <fcntl.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <regex>
#include <thread>

#include "core/profile.h"
#include "core/records.h"

namespace drape {
namespace {

namespace fs = std::filesystem;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Coverage is stored in steps of 1/65535; rounding is off by half of one.
constexpr double kCoverageTolerance = 0.5 / 65535 + 1e-12;

/// A fan of six triangles around a fixed hexagon's centre; the grid is not square on purpose.
RecordsHeader make_header() {
  RecordsHeader header;
  header.config = "[experiment]\nkind = \"drape\"  # Grüße\n";
  header.seed = 0xfedcba9876543210;
  header.git_commit = "0123abc";
  header.compiler = "g++ 12.2";
  header.mesh_id = "disc_7";
  header.rest_uv.resize(7, 2);
  header.rest_uv.row(6).setZero();
  header.triangles.resize(6, 3);
  for (int i = 0; i < 6; ++i) {
    header.rest_uv.row(i) << 0.15 * std::cos(i * M_PI / 3), 0.15 * std::sin(i * M_PI / 3);
    header.triangles.row(i) << 6, i, (i + 1) % 6;
  }
  header.fixed = {0, 0, 0, 0, 0, 0, 1};
  header.clamp_wing_factor = 1.75;
  header.scene = {0.14, 0.08, 9.81};
  header.reading = {BendingLaw::secant, BendingThreshold::radius};
  header.grid = {5, 8, 0.05, Vec2(-0.2, -0.125)};
  return header;
}

/// Values in [0, 1), the same on every library.
struct Uniform {
  explicit Uniform(int seed) : engine(static_cast<std::uint64_t>(seed)) {}
  double operator()() { return static_cast<double>(engine() >> 11) * 0x1p-53; }
  VecX vector(Eigen::Index size) {
    return VecX::NullaryExpr(size, [this](Eigen::Index) { return (*this)(); });
  }
  std::mt19937_64 engine;
};

Fabric make_fabric(Uniform& uniform) {
  Fabric fabric;
  for (Parameter p : all_parameters()) fabric[p] *= 0.5 + uniform();
  return fabric;
}

SolveStats make_stats(Uniform& uniform, const std::string& status) {
  return {status, "gravity ramp", uniform(), uniform(), 12, 34, 1, 56, -uniform(), uniform()};
}

Record make_record(int index, const RecordsHeader& header) {
  Uniform uniform(index);
  Record record;
  record.id = std::to_string(index);
  record.name = "wool „flannel“";
  record.category = "woven";
  record.subcategory = "twill";
  record.type = "";
  record.composition = "80 % wool, 20 % polyamide";
  record.fabric = make_fabric(uniform);
  record.positions = uniform.vector(3 * header.rest_uv.rows());
  record.stats = make_stats(uniform, "converged");
  record.observation = {
      uniform.vector(kProfileSize),
      CoverageImage::NullaryExpr(header.grid.rows, header.grid.columns,
                                 [&](Eigen::Index, Eigen::Index) { return uniform(); }),
      0.37, 7};
  record.observation.coverage(0, 0) = 0;
  record.observation.coverage(0, 1) = 1;
  return record;
}

EstimateRecord make_estimate(int index, const RecordsHeader& header) {
  Uniform uniform(1000 + index);
  EstimateRecord estimate;
  estimate.fabric = make_fabric(uniform);
  estimate.start = make_fabric(uniform);
  estimate.log_sd = uniform.vector(kParameterCount);
  estimate.log_sd[1] = kNaN;
  estimate.positions = uniform.vector(3 * header.rest_uv.rows());
  estimate.stats = make_stats(uniform, "stalled");
  estimate.outcome = "succeeded";
  estimate.branch_shared = index % 2 == 0;
  estimate.outline_rms = 1.5e-3;
  estimate.iou = 0.97;
  estimate.drape_coefficient = 0.42;
  estimate.node_count = 8;
  estimate.forward_solves = 21;
  estimate.profile = uniform.vector(kProfileSize);
  estimate.start_profile = uniform.vector(kProfileSize);
  return estimate;
}

/// Equal bit by bit, or NaN in the same places.
bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }
bool same(const VecX& a, const VecX& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return same(x, y); });
}
bool same(const Fabric& a, const Fabric& b) { return to_vector(a) == to_vector(b); }
bool same(const SolveStats& a, const SolveStats& b) {
  return a.status == b.status && a.protocol == b.protocol &&
         same(a.residual_relative, b.residual_relative) &&
         same(a.rounding_floor, b.rounding_floor) && a.newton_iterations == b.newton_iterations &&
         a.factorizations == b.factorizations && a.negative_eigenvalues == b.negative_eigenvalues &&
         a.wings_past_threshold == b.wings_past_threshold && same(a.energy, b.energy) &&
         same(a.cpu_seconds, b.cpu_seconds);
}

void expect_same(const EstimateRecord& a, const EstimateRecord& b) {
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
}

void expect_same(const Record& a, const Record& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.category, b.category);
  EXPECT_EQ(a.subcategory, b.subcategory);
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.composition, b.composition);
  EXPECT_TRUE(same(a.fabric, b.fabric));
  EXPECT_TRUE(same(a.positions, b.positions));
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

::testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\"" << part << "\" is not in:\n" << text;
}

::testing::AssertionResult matches(const std::string& text, const std::string& pattern) {
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
bool holds_in_child(const std::function<bool()>& action) {
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

void overwrite_text(hid_t file, const char* attribute, const char* text) {
  const hid_t id = H5Aopen_by_name(file, "/", attribute, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Aget_type(id);
  ASSERT_GE(H5Awrite(id, type, &text), 0);
  H5Tclose(type);
  H5Aclose(id);
}

void overwrite_number(hid_t file, const char* object, const char* attribute, double number) {
  const hid_t id = H5Aopen_by_name(file, object, attribute, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Awrite(id, H5T_NATIVE_DOUBLE, &number), 0);
  H5Aclose(id);
}

void overwrite_first(hid_t file, const char* dataset, double number) {
  const hid_t id = H5Dopen2(file, dataset, H5P_DEFAULT);
  const hid_t space = H5Dget_space(id);
  hsize_t zeros[3] = {0, 0, 0}, ones[3] = {1, 1, 1};
  H5Sselect_hyperslab(space, H5S_SELECT_SET, zeros, nullptr, ones, nullptr);
  const hid_t one = H5Screate_simple(1, ones, nullptr);
  ASSERT_GE(H5Dwrite(id, H5T_NATIVE_DOUBLE, one, space, H5P_DEFAULT, &number), 0);
  H5Sclose(one);
  H5Sclose(space);
  H5Dclose(id);
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

// The names that other programs rely on, checked without the code under test.
TEST_F(Records, LayoutOnDisk) {
  std::vector<Record> records{make_record(0, header_), make_record(1, header_)};
  records[0].observation.coverage(0, 0) = 1;  // row 0 comes first on disk
  records[0].estimate = make_estimate(0, header_);
  write_records(file_, header_, records);
  const hid_t file = H5Fopen(file_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const auto shape = [file](const std::string& path) {
    std::vector<hsize_t> sizes(4, 0);
    const hid_t data = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
    EXPECT_GE(data, 0) << path;
    const hid_t space = H5Dget_space(data);
    sizes.resize(static_cast<size_t>(H5Sget_simple_extent_dims(space, sizes.data(), nullptr)));
    H5Sclose(space);
    H5Dclose(data);
    return sizes;
  };
  using Sizes = std::vector<hsize_t>;
  EXPECT_EQ(shape("/mesh/disc_7/rest_uv"), (Sizes{7, 2}));
  EXPECT_EQ(shape("/mesh/disc_7/triangles"), (Sizes{6, 3}));
  EXPECT_EQ(shape("/mesh/disc_7/fixed"), (Sizes{7}));
  for (const char* group : {"/params/", "/params_estimated/", "/params_estimated_log_sd/"})
    for (Parameter p : all_parameters())
      EXPECT_EQ(shape(group + std::string(name(p))), (Sizes{2})) << name(p);
  for (const char* path :
       {"/fabric/id", "/fabric/name", "/fabric/category", "/fabric/subcategory", "/fabric/type",
        "/fabric/composition", "/stats/status", "/stats/protocol", "/stats/residual_relative",
        "/stats/newton_iterations", "/stats/negative_eigenvalues", "/stats/cpu_seconds",
        "/observation/drape_coefficient", "/observation/node_count"})
    EXPECT_EQ(shape(path), (Sizes{2})) << path;
  EXPECT_EQ(shape("/sim/positions"), (Sizes{2, 7, 3}));
  EXPECT_EQ(shape("/sim_estimated/positions"), (Sizes{2, 7, 3}));
  EXPECT_EQ(shape("/observation/profile"), (Sizes{2, 360}));
  EXPECT_EQ(shape("/observation/coverage"), (Sizes{2, 5, 8}));
  for (const char* attribute : {"schema", "version", "config", "seed", "git_commit", "compiler",
                                "gravity", "bending_law", "bending_threshold"})
    EXPECT_GT(H5Aexists(file, attribute), 0) << attribute;
  EXPECT_GT(H5Aexists_by_name(file, "/sim", "mesh", H5P_DEFAULT), 0);
  EXPECT_GT(H5Aexists_by_name(file, "/mesh/disc_7", "clamp_wing_factor", H5P_DEFAULT), 0);
  EXPECT_GT(H5Aexists_by_name(file, "/observation/coverage", "pixel_size_m", H5P_DEFAULT), 0);
  EXPECT_GT(H5Aexists_by_name(file, "/observation/coverage", "origin_m", H5P_DEFAULT), 0);

  std::vector<double> positions(2 * 7 * 3);
  const hid_t sim = H5Dopen2(file, "/sim/positions", H5P_DEFAULT);
  H5Dread(sim, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, positions.data());
  EXPECT_EQ(positions[21 + 3 * 5 + 2], position(records[1].positions, 5).z());
  const hid_t storage = H5Dget_create_plist(sim);
  hsize_t chunk[3] = {0, 0, 0};
  ASSERT_EQ(H5Pget_chunk(storage, 3, chunk), 3);
  EXPECT_EQ(chunk[0], 1u);
  EXPECT_EQ(chunk[1], 7u);
  EXPECT_EQ(H5Pget_nfilters(storage), 3);  // shuffle, gzip, check sum
  H5Pclose(storage);
  H5Dclose(sim);

  std::vector<std::uint16_t> coverage(2 * 5 * 8);
  const hid_t image = H5Dopen2(file, "/observation/coverage", H5P_DEFAULT);
  H5Dread(image, H5T_NATIVE_UINT16, H5S_ALL, H5S_ALL, H5P_DEFAULT, coverage.data());
  EXPECT_EQ(coverage[0], 65535);
  EXPECT_EQ(coverage[8 + 3], std::lround(65535 * records[0].observation.coverage(1, 3)));
  H5Dclose(image);
  H5Fclose(file);
}

TEST_F(Records, WithoutEstimatesTheirGroupsAreLeftOut) {
  write_example();
  change([](hid_t file) {
    for (const char* group : {"estimate", "params_estimated", "params_estimated_log_sd",
                              "params_start", "sim_estimated", "stats_estimated"})
      EXPECT_EQ(H5Lexists(file, group, H5P_DEFAULT), 0) << group;
  });
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

TEST_F(Records, WhatIsNoFileOfRecordsIsNamed) {
  EXPECT_TRUE(contains(error(), "results.h5: no such file"));
  std::ofstream(file_) << "not HDF5";
  EXPECT_TRUE(contains(error(), "results.h5: is not an HDF5 file"));
  H5Fclose(H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_TRUE(contains(error(), "attribute schema of / is missing"));
  EXPECT_TRUE(contains(error(), "must be \"drape-records\""));
}

TEST_F(Records, WhatIsWrongInAFileIsNamed) {
  const auto named = [this](const std::function<void(hid_t)>& edit, const std::string& message) {
    write_example();
    change(edit);
    EXPECT_TRUE(contains(error(), "results.h5: "));
    EXPECT_TRUE(contains(error(), message));
  };
  named([](hid_t file) { overwrite_text(file, "schema", "other"); },
        "has the schema \"other\", must be \"drape-records\"");
  named([](hid_t file) { overwrite_number(file, "/", "version", 2); },
        "has version 2 of drape-records, this program reads version 1: use a newer program");
  named([](hid_t file) { H5Adelete(file, "gravity"); }, "attribute gravity of / is missing");
  named([](hid_t file) { overwrite_number(file, "/", "gravity", -1); }, "scene gravity = -1");
  named([](hid_t file) { overwrite_text(file, "bending_law", "cubic"); }, "bending law 'cubic'");
  named([](hid_t file) { H5Ldelete(file, "/params/k_bh", H5P_DEFAULT); },
        "dataset /params/k_bh is missing or damaged, must be f64 [2]");
  named([](hid_t file) { H5Ldelete(file, "/observation", H5P_DEFAULT); },
        "dataset /observation/coverage is missing or damaged, must be u16 [any, any, any]");
  named([](hid_t file) { H5Lmove(file, "/mesh/disc_7/fixed", file, "/sim/positions2", {}, {}); },
        "dataset /mesh/disc_7/fixed is missing");
  named(
      [](hid_t file) {
        H5Ldelete(file, "/sim/positions", H5P_DEFAULT);
        H5Lcreate_hard(file, "/observation/profile", file, "/sim/positions", {}, {});
      },
      "dataset /sim/positions is f64 [2, 360], must be f64 [2, 7, 3]");
  named(
      [](hid_t file) {
        H5Ldelete(file, "/params/k_u", H5P_DEFAULT);
        H5Lcreate_hard(file, "/fabric/name", file, "/params/k_u", {}, {});
      },
      "dataset /params/k_u is text [2], must be f64 [2]");
  named([](hid_t file) { overwrite_first(file, "/mesh/disc_7/rest_uv", kNaN); },
        "rest_uv: must be finite");
  named([](hid_t file) { overwrite_first(file, "/mesh/disc_7/triangles", 7); },
        "hold the vertices 0 to 7: must be within 0 to 6");
  named([](hid_t file) { overwrite_first(file, "/mesh/disc_7/fixed", 3); },
        "fixed: must be 0 or 1");
  named([](hid_t file) { overwrite_first(file, "/params/areal_density", -0.1); },
        "record 0: fabric parameter areal_density = -0.1");
}

TEST_F(Records, TruncatedFilesAreRefused) {
  write_example();
  const auto size = fs::file_size(file_);
  for (const std::uintmax_t left : {size - 1, size / 2, std::uintmax_t{100}}) {
    fs::resize_file(file_, left);
    EXPECT_TRUE(contains(error(), "results.h5: is damaged")) << left;
  }
}

/// Spoils four bytes of a file.
void damage(const fs::path& file, std::uint64_t position) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(static_cast<std::streamoff>(position));
  stream << "dama";
}

TEST_F(Records, DamagedDataAreRefused) {
  for (const char* path : {"/sim/positions", "/observation/coverage", "/params/k_u"}) {
    write_example();
    haddr_t address = 0;
    hsize_t bytes = 0;
    change([&](hid_t file) {
      const hid_t data = H5Dopen2(file, path, H5P_DEFAULT);
      const hid_t space = H5Dget_space(data);
      hsize_t offset[3];
      unsigned mask = 0;
      ASSERT_GE(H5Dget_chunk_info(data, space, 0, offset, &mask, &address, &bytes), 0);
      H5Sclose(space);
      H5Dclose(data);
    });
    damage(file_, address + bytes / 2);
    EXPECT_TRUE(contains(error(), std::string("dataset ") + path + " cannot be read"));
  }
}

TEST_F(Records, DamagedMetadataAreRefused) {
  write_example();
  std::ifstream stream(file_, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const std::string signature = "OHDR";  // opens the header of a group or dataset
  int headers = 0;
  for (size_t at = bytes.find(signature); at != std::string::npos;
       at = bytes.find(signature, at + 1)) {
    if (headers++ % 8 != 0) continue;
    write_example();
    damage(file_, at + 20);
    EXPECT_TRUE(holds_in_child([this] { return !error().empty(); })) << "object header at " << at;
  }
  EXPECT_GT(headers, 40);  // there is one a column
}

TEST_F(Records, TheLibraryStaysSilent) {
  ::testing::internal::CaptureStderr();
  EXPECT_FALSE(error().empty());
  std::ofstream(file_) << "not HDF5";
  EXPECT_FALSE(error().empty());
  write_example();
  change([](hid_t file) { H5Ldelete(file, "/params", H5P_DEFAULT); });
  EXPECT_FALSE(error().empty());
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

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
