// Datasets as a user meets them: cut into shards, merged, verified, exported, imported.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/hdf5_file.h"
#include "core/random.h"
#include "core/records.h"
#include "core/sha256.h"
#include "tests/experiments/program_fixture.h"

namespace drape {
namespace {

class Dataset : public ProgramInFolder {
 protected:
  void SetUp() override {
    scratch.write("d.toml",
                  "[experiment]\nkind = 'dataset'\n[mesh]\nvertices = 250\n[start]\n"
                  "protocol = 'lobes'\n[fabric]\nbending_threshold = 'radius'\n"
                  "[dataset]\nfabrics = 12\npixels = 32\n");
  }

  void run(const std::string& arguments) const {
    const Ended ended = drape("run d.toml --threads 1 " + arguments);
    ASSERT_EQ(ended.exit_code, 0) << ended.text;
  }
  std::string table(const std::string& run) const {
    return (scratch / run / "results.h5").string();
  }

  /// The fabrics of d.toml in one run, made once for all tests: its table.
  std::string whole() const {
    static const ScratchFolder folder;
    if (!std::filesystem::exists(folder / "whole")) run("--out " + (folder / "whole").string());
    return (folder / "whole/results.h5").string();
  }
  /// The same table, to be changed, as a/results.h5.
  void copy_whole() const {
    std::filesystem::create_directory(scratch / "a");
    std::filesystem::copy_file(whole(), table("a"));
    std::filesystem::copy_file(checksum_file(whole()), checksum_file(table("a")));
  }

  /// Whatever is not a time and not a name of the run.
  void expect_same(const std::string& one, const std::string& other) const {
    const std::vector<Record> a = read_records(one), b = read_records(other);
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].id, b[i].id);
      EXPECT_EQ(a[i].type, b[i].type);
      EXPECT_EQ(a[i].composition, b[i].composition);
      EXPECT_EQ(to_vector(a[i].fabric), to_vector(b[i].fabric));
      EXPECT_EQ(a[i].positions, b[i].positions);
      EXPECT_EQ(a[i].contact_force, b[i].contact_force);
      EXPECT_EQ(a[i].stats.status, b[i].stats.status);
      EXPECT_EQ(a[i].stats.residual_relative, b[i].stats.residual_relative);
      EXPECT_EQ(a[i].stats.energy, b[i].stats.energy);
      EXPECT_EQ(a[i].observation.profile, b[i].observation.profile);
      EXPECT_EQ(a[i].observation.coverage, b[i].observation.coverage);
    }
  }

  void expect_refused(const std::string& arguments, const std::string& message) const {
    const Ended ended = drape(arguments);
    EXPECT_EQ(ended.exit_code, 2) << arguments << "\n" << ended.text;
    EXPECT_TRUE(ended.says(message)) << arguments << "\n" << ended.text;
  }
};

TEST_F(Dataset, ShardsMergeToTheWholeSet) {
  for (const char* k : {"1", "2", "3"})
    run("--out shard" + std::string(k) + " --shard " + k + "/3");
  EXPECT_EQ(read_records(table("shard2")).front().id, "4");

  expect_refused("dataset merge m.h5 shard1/results.h5 shard3/results.h5", "shard 2/3 is missing");
  expect_refused("dataset merge m.h5 shard1/results.h5 shard1/results.h5", "are both shard 1/3");
  expect_refused("dataset merge m.h5 " + whole(), "is no shard");
  expect_refused("run d.toml --out x --shard 4/3", "dataset.shard");
  expect_refused("run d.toml --out x --shard 4", "expected K/N");

  const std::string parts = "shard3/results.h5 shard1/results.h5 shard2/results.h5";
  for (const std::string options : {"", "--virtual "}) {
    const std::string file = options.empty() ? "copy.h5" : "view.h5";
    const Ended merged = drape("dataset merge " + options + file + " " + parts);
    ASSERT_EQ(merged.exit_code, 0) << merged.text;
    EXPECT_TRUE(merged.says("12 records")) << merged.text;
    expect_same((scratch / file).string(), whole());
    EXPECT_EQ(read_header(scratch / file).config, read_header(whole()).config);
    expect_refused("dataset merge " + file + " " + parts, "is there already");
    const Ended verified = drape("dataset verify " + file);
    EXPECT_EQ(verified.exit_code, 0) << verified.text;
    EXPECT_TRUE(verified.says("recomputed    residual and outline of 10")) << verified.text;
  }
  std::filesystem::remove(scratch / "shard2/results.h5");
  expect_refused("dataset verify view.h5", "shard2/results.h5, which is not there");
  expect_refused("info view.h5", "which is not there");
}

TEST_F(Dataset, VerifyFindsWhatIsWrong) {
  copy_whole();
  const std::string good = scratch.read("a/results.h5");
  EXPECT_EQ(drape("dataset verify a/results.h5").exit_code, 0);

  // a flipped bit is told by its sum alone; without the list, by HDF5 or by the content
  Random random(11);
  for (int trial = 0; trial < 12; ++trial) {
    std::string bad = good;
    const auto place = static_cast<size_t>(random.uniform() * static_cast<double>(bad.size()));
    bad[place] = static_cast<char>(bad[place] ^ (1 << (trial % 8)));
    scratch.write("a/results.h5", bad);
    expect_refused("dataset verify a/results.h5", "damaged or changed");
    scratch.write("b.h5", bad);
    for (const char* command : {"dataset verify b.h5", "info b.h5"}) {
      const Ended ended = drape(command);
      EXPECT_TRUE(ended.exit_code == 0 || ended.exit_code == 2) << ended.text;  // gaps hold bits
    }
  }
  for (const double share : {0.0, 0.01, 0.5, 0.99}) {
    scratch.write("b.h5", good.substr(0, static_cast<size_t>(share * double(good.size()))));
    expect_refused("dataset verify b.h5", "b.h5");
    expect_refused("info b.h5", "b.h5");
  }

  // well-formed, but wrong
  scratch.write("a/results.h5", good);
  const RecordsHeader header = read_header(table("a"));
  const auto altered = [&](const std::function<void(std::vector<Record>&)>& change,
                           const std::string& message) {
    std::vector<Record> records = read_records(table("a"));
    change(records);
    write_records(scratch / "c.h5", header, records);
    expect_refused("dataset verify c.h5", message);
  };
  altered([](auto& records) { records[1].positions[3 * 200 + 2] += 1e-4; },
          "record 1: the residual of its positions");
  altered([](auto& records) { records[2].observation.profile[7] += 1e-6; },
          "record 2: profile or drape coefficient");
  altered([](auto& records) { records[2].id = records[0].id; }, "the id 0 occurs twice");
  altered([](auto& records) { records[0].observation.node_count = -3; }, "is no count");
  altered([](auto& records) { records[0].positions[9] = NAN; }, "are not finite");
  expect_refused("dataset verify none.h5", "no such file");
}

TEST_F(Dataset, IsExportedAndMigrated) {
  copy_whole();
  ASSERT_EQ(drape("dataset export a/results.h5 --csv a.csv").exit_code, 0);
  const std::string csv = scratch.read("a.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
  EXPECT_EQ(csv.find("id,name,category,"), 0u);
  expect_refused("dataset export a/results.h5 --csv a.csv", "is there already");
  expect_refused("dataset export a/results.h5 --obj a.obj --record 12", "there is no record 12");
  expect_refused("dataset export a/results.h5", "option");
  expect_refused("dataset exprt a/results.h5", "did you mean 'export'?");

  ASSERT_EQ(drape("dataset export a/results.h5 --obj a.obj --record 1").exit_code, 0);
  const std::string obj = scratch.read("a.obj");
  const RecordsHeader header = read_header(table("a"));
  const auto lines = [&](const std::string& start) {
    int count = 0;
    for (size_t at = 0; (at = obj.find("\n" + start, at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(lines("v "), header.rest_uv.rows());
  EXPECT_EQ(lines("vt "), header.rest_uv.rows());
  EXPECT_EQ(lines("f "), header.triangles.rows());
  ASSERT_EQ(drape("dataset export a/results.h5 --vtu a.vtu --record 1").exit_code, 0);
  EXPECT_NE(scratch.read("a.vtu").find("NumberOfPoints=\"" + std::to_string(header.rest_uv.rows())),
            std::string::npos);

  // as version 1 was: no contact, and no column of the support
  scratch.write("old.h5", scratch.read("a/results.h5"));
  {
    const hdf5::Lock lock;
    const hid_t file = H5Fopen((scratch / "old.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const std::uint64_t one = 1;
    const hid_t version = H5Aopen(file, "version", H5P_DEFAULT);
    ASSERT_GE(H5Awrite(version, H5T_NATIVE_UINT64, &one), 0);
    H5Aclose(version);
    H5Adelete(file, "column_radius");
    for (const char* name : {"contact", "self_intersections", "support_penetration"})
      ASSERT_GE(H5Ldelete(file, ("/stats/" + std::string(name)).c_str(), H5P_DEFAULT), 0);
    ASSERT_GE(H5Fclose(file), 0);
  }
  const Ended migrated = drape("dataset migrate old.h5 new.h5");
  ASSERT_EQ(migrated.exit_code, 0) << migrated.text;
  EXPECT_TRUE(drape("info new.h5").says("drape-records 3"));
  EXPECT_EQ(read_records(scratch / "new.h5").at(1).positions,
            read_records(table("a")).at(1).positions);

  ASSERT_EQ(drape("dataset migrate a/results.h5 b.h5").exit_code, 0);
  expect_same((scratch / "b.h5").string(), table("a"));
  EXPECT_EQ(verify_checksum(scratch / "b.h5"), ChecksumState::matches);
}

TEST_F(Dataset, OfSeveralRadiiAndProtocols) {
  const std::string several =
      " --set dataset.radii=[0.15,0.12] --set 'dataset.protocols=[\"lobes\",\"coarse_ramp\"]'"
      " --set dataset.fabrics=3";
  run("--out a" + several);
  const std::vector<Record> records = read_records(table("a"));
  ASSERT_EQ(records.size(), 6u);
  EXPECT_EQ(records[2].id, "1:lobes");
  EXPECT_EQ(records[3].id, "1:coarse_ramp");
  EXPECT_EQ(records[3].name, "1");
  EXPECT_EQ(records[2].type, records[3].type);
  EXPECT_EQ(to_vector(records[2].fabric), to_vector(records[3].fabric));
  EXPECT_NE(records[2].stats.protocol, records[3].stats.protocol);

  // the other radius: the same fabrics, a table that knows its radius, the same pixels per specimen
  const std::string smaller = table("a/radius_120mm");
  EXPECT_EQ(to_vector(read_records(smaller).at(4).fabric), to_vector(records[4].fabric));
  const RecordsHeader first = read_header(table("a")), other = read_header(smaller);
  EXPECT_EQ(first.scene.specimen_radius, 0.15);
  EXPECT_EQ(other.scene.specimen_radius, 0.12);
  // to rounding
  EXPECT_NEAR(other.grid.pixel_size / first.grid.pixel_size, 0.8, 1e-12);
  for (const std::string& file : {table("a"), smaller}) {
    const Ended verified = drape("dataset verify " + file);
    EXPECT_EQ(verified.exit_code, 0) << verified.text;
  }
  EXPECT_EQ(drape("dataset export " + smaller + " --csv a.csv").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(scratch / "a/radius_120mm/dataset.png"));

  for (const char* k : {"1", "2"})
    run("--out s" + std::string(k) + several + " --shard " + k + "/2");
  for (const std::string part : {"/", "/radius_120mm/"}) {
    std::filesystem::remove(scratch / "m.h5");
    const Ended merged =
        drape("dataset merge m.h5 s1" + part + "results.h5 s2" + part + "results.h5");
    ASSERT_EQ(merged.exit_code, 0) << merged.text;
    expect_same((scratch / "m.h5").string(), table("a" + part));
  }
  expect_refused("dataset merge n.h5 s1/results.h5 s2/radius_120mm/results.h5",
                 "is not of the set");
  expect_refused("validate d.toml --set dataset.radii=[0.08]", "larger than scene.support_radius");
  expect_refused("validate d.toml --set 'dataset.protocols=[\"guided\"]'",
                 "cannot hold \"guided\"");
}

TEST_F(Dataset, OfAGarmentProgramsTable) {
  scratch.write("t.csv",
                "id,type,category,density,fSuK,fSvK,fHK,fBuK,fBvK,fBhK\n"
                "x,Twill,Woven,168,1e6,1e6,5e4,20000,20000,20000\n");
  run("--out a --set dataset.parameters=t.csv");
  const Record record = read_records(table("a")).at(0);
  EXPECT_EQ(record.id, "x");
  EXPECT_EQ(record.fabric.k_bu, 20000 * 1e-9);
  scratch.write("t.csv", "id,density\nx,1\n");
  expect_refused("run d.toml --out b --set dataset.parameters=t.csv", "t.csv:1: the header lacks");
  EXPECT_FALSE(std::filesystem::exists(scratch / "b"));
}

TEST_F(Dataset, FailuresAreReplayed) {
  const Ended ended =
      drape("run d.toml --out a --threads 1 --set dataset.fabrics=3 --set solver.max_iterations=1");
  EXPECT_EQ(ended.exit_code, 3) << ended.text;
  const auto summary = nlohmann::json::parse(scratch.read("a/summary.json"));
  ASSERT_EQ(summary["failures"].size(), 3u);
  const std::string replay = summary["failures"][2]["replay"];
  ASSERT_EQ(replay.rfind("drape ", 0), 0u);
  EXPECT_EQ(drape(replay.substr(6)).exit_code, 3);
  const std::vector<Record> again = read_records(table("a/replay_2"));
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(to_vector(again[0].fabric), to_vector(read_records(table("a")).at(2).fabric));
  expect_refused("run d.toml --out b --set dataset.only=[12]", "the set has 0 to 11");
}

}  // namespace
}  // namespace drape
