#include <gtest/gtest.h>

#include <limits>

#include "core/version.h"
#include "experiments/summary.h"
#include "tests/experiments/scratch_folder.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

const RunStart kNow{.cpu_seconds = 0};

TEST(Summary, CommonKeysThenTheKindsOwn) {
  const Json all = summary(Kind::gradient_check, {"partial", {{"fabrics", 20}}}, kNow);
  std::vector<std::string> keys;
  for (const auto& [key, value] : all.items()) keys.push_back(key);
  EXPECT_EQ(keys,
            (std::vector<std::string>{"kind", "status", "cpu_seconds", "wall_seconds",
                                      "peak_memory_bytes", "version", "git_commit", "fabrics"}));
  EXPECT_EQ(all["kind"], "gradient_check");
  EXPECT_EQ(all["status"], "partial");
  EXPECT_EQ(all["version"], version());
  EXPECT_GT(all["cpu_seconds"], 0);
  EXPECT_GE(all["wall_seconds"], 0);
  EXPECT_GT(all["peak_memory_bytes"], 1000000);  // no program of ours needs less than a megabyte
}

TEST(Summary, KindsOwnMayBeMissingButNotRepeat) {
  EXPECT_EQ(summary(Kind::drape, {"ok", {}}, kNow).size(), 7u);
  EXPECT_THROW(summary(Kind::drape, {"ok", {{"version", "2"}}}, kNow), std::logic_error);
}

TEST(Summary, WhatJsonCannotSay) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Json values{{"a", std::nan("")}, {"b", infinity}, {"c", {-infinity, 1.5}}, {"d", "\xff"}};
  const Json read = Json::parse(summary_text(values));
  EXPECT_TRUE(read["a"].is_null());
  EXPECT_TRUE(read["b"].is_null());
  EXPECT_TRUE(read["c"][0].is_null());
  EXPECT_EQ(read["c"][1], 1.5);
  EXPECT_EQ(read["d"], "\xef\xbf\xbd");
}

TEST(Summary, FinishesARun) {
  const ScratchFolder scratch;
  {
    const OutputFolder folder(scratch / "run", {});
    write_summary(folder, summary(Kind::drape, {"failed", {}}, kNow));
  }
  const OutputFolder folder(scratch / "run", {});
  EXPECT_EQ(folder.state(), OutputFolder::State::finished);
  EXPECT_EQ(read_status(folder), "failed");
  for (const char* damaged : {"", "{", "[]", "{}", "{\"status\": 3}"}) {
    scratch.write("run/summary.json", damaged);
    EXPECT_THROW(read_status(folder), std::invalid_argument) << damaged;
  }
}

}  // namespace
}  // namespace drape
