// kind = "paper": several experiments in one run, their figures on one page.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "tests/experiments/program_fixture.h"

namespace drape {
namespace {

class Paper : public ProgramInFolder {
 protected:
  void SetUp() override {
    scratch.write("set.toml",
                  "[experiment]\nkind = 'dataset'\n[mesh]\nvertices = 200\n"
                  "[dataset]\nfabrics = 2\npixels = 32\n");
    scratch.write("one.toml", "[experiment]\nkind = 'drape'\n[mesh]\nvertices = 200\n");
    scratch.write("p.toml",
                  "[experiment]\nkind = 'paper'\n[paper]\nconfigs = ['set.toml', 'one.toml']\n");
  }
};

TEST_F(Paper, RunsItsPartsAndCollectsTheirFigures) {
  const Ended ended = drape("run p.toml --out out --threads 1");
  ASSERT_EQ(ended.exit_code, 0) << ended.text;
  for (const char* file : {"set_dataset.pdf", "set_dataset.png", "set_renders.pdf",
                           "set_renders.png", "one/summary.json", "summary.json"})
    EXPECT_TRUE(std::filesystem::exists(scratch / "out" / file)) << file;
  const std::string page = scratch.read("out/figures.html");
  for (const char* text : {"data:image/png;base64,", "Figure 2.", "set.toml", "one.toml", "commit",
                           "vertices = 200", "drape coefficient"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("http"), std::string::npos);  // it opens offline
}

TEST_F(Paper, RendersAgainOnlyWhatIsOlderThanItsTable) {
  scratch.write("p.toml", "[experiment]\nkind = 'paper'\n[paper]\nconfigs = ['set.toml']\n");
  const auto drawn = [&] {
    std::filesystem::remove(scratch / "out/summary.json");
    EXPECT_EQ(drape("run p.toml --out out --threads 1").exit_code, 0);
    return std::filesystem::last_write_time(scratch / "out/set/renders.pdf");
  };
  const auto first = drawn();
  EXPECT_EQ(drawn(), first);
  std::filesystem::last_write_time(scratch / "out/set/results.h5", first + std::chrono::seconds(1));
  EXPECT_GT(drawn(), first);
}

TEST_F(Paper, TakesUpFinishedParts) {
  scratch.write("two.toml", scratch.read("one.toml"));
  scratch.write("p.toml",
                "[experiment]\nkind = 'paper'\n[paper]\nconfigs = ['one.toml', 'two.toml']\n");
  ASSERT_EQ(drape("run p.toml --out out --threads 1").exit_code, 0);
  const auto before = std::filesystem::last_write_time(scratch / "out/one/summary.json");
  std::filesystem::remove(scratch / "out/summary.json");
  std::filesystem::remove_all(scratch / "out/two");
  const Ended again = drape("run p.toml --out out --threads 1");
  EXPECT_EQ(again.exit_code, 0) << again.text;
  EXPECT_EQ(std::filesystem::last_write_time(scratch / "out/one/summary.json"), before);
  EXPECT_TRUE(std::filesystem::exists(scratch / "out/two/summary.json"));
}

TEST_F(Paper, RefusesWhatItCannotRun) {
  const auto expect_refused = [&](const std::string& configs, const std::string& message) {
    scratch.write("bad.toml", "[experiment]\nkind = 'paper'\n[paper]\nconfigs = " + configs + "\n");
    const Ended ended = drape("run bad.toml --out out");
    EXPECT_EQ(ended.exit_code, 2) << ended.text;
    EXPECT_TRUE(ended.says(message)) << ended.text;
  };
  expect_refused("[]", "paper.configs");
  expect_refused("['no.toml']", "there is no file");
  scratch.write("wrong.toml", "[experiment]\nkind = 'drape'\n[mesh]\nvertices = -1\n");
  expect_refused("['one.toml', 'wrong.toml']", "wrong.toml:4:12");
  std::filesystem::create_directory(scratch / "other");
  scratch.write("other/one.toml", scratch.read("one.toml"));
  expect_refused("['one.toml', 'other/one.toml']", "two configs are named one");
  expect_refused("['p.toml']", "cannot hold another");
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

}  // namespace
}  // namespace drape
