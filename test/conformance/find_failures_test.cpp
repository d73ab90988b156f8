#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

// scripts/find-failures with a program in place of the simulation, whose robot touches a post that stands in
// one corner of the room and nothing else.

namespace priamos {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kProgram = R"(#!/usr/bin/env python3
import json, pathlib, sys, tomllib
words = sys.argv
folder = pathlib.Path(words[words.index("--deployment") + 1])
world = tomllib.loads((folder / "worlds" / "failure.toml").read_text())
post = next(b for b in world["boxes"] if b["name"] == "post")
gap = max(0.0, abs(post["x_m"] - 5.3) - 0.15) + max(0.0, abs(post["y_m"] - 3.1) - 0.15)
touch = [{"t_s": 1, "kind": "driven", "thing": "post", "noticed_after_s": None}] if gap == 0 else []
summary = {"passed": gap > 0, "contacts": len(touch), "touches": touch, "min_gap_m": gap, "reason": None}
pathlib.Path(words[words.index("--json") + 1]).write_text(json.dumps(summary))
with open(pathlib.Path(words[0]).parent / "runs", "a") as runs:
    runs.write("run\n")
)";

class FindFailuresTest : public ::testing::Test {
 protected:
  FindFailuresTest() {
    std::ofstream(folder_ / "priamos") << kProgram;
    chmod((folder_ / "priamos").c_str(), 0755);
  }
  ShellAnswer Run(const std::string& words) const {
    return RunShell("cd '" + std::string(PRIAMOS_SOURCE_DIR) +
                    "' && PYTHONDONTWRITEBYTECODE=1 scripts/find-failures --into '" + into_.string() +
                    "' --programs '" + (folder_ / "").string() + "' " + words);
  }
  std::size_t Runs() const {
    std::ifstream in(folder_ / "runs");
    std::size_t count = 0;
    for (std::string line; std::getline(in, line);) ++count;
    return count;
  }
  std::vector<fs::path> Found() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(into_))
      if (entry.path().filename().string().starts_with("failure-")) found.push_back(entry.path());
    return found;
  }
  const TemporaryFolder folder_;
  const fs::path into_ = folder_ / "found";
};

TEST_F(FindFailuresTest, FindsWhatChanceHardlyDoesAndWritesItOutAsAScenario) {
  const auto answer = Run("--vary post --evaluations 60 --population 12");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  ASSERT_GE(Found().size(), 5u) << answer.text;  // chance alone: 2 of 60
  EXPECT_THAT(answer.text, HasSubstr("driven post, never noticed  priamos lockstep --deployment"));
  for (const char* file :
       {"scenarios/failure.toml", "worlds/failure.toml", "maps/door.toml", "link.toml", "failure.json"})
    EXPECT_TRUE(fs::exists(Found()[0] / file)) << file;
}

TEST_F(FindFailuresTest, GoesOnWhereItWasStopped) {
  Run("--vary post --evaluations 24 --population 12");
  ASSERT_EQ(Runs(), 24u);
  Run("--vary post --evaluations 36 --population 12");
  EXPECT_EQ(Runs(), 36u);
  const auto other = Run("--vary start --evaluations 12");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.text, HasSubstr("holds another search"));
}

TEST_F(FindFailuresTest, WrongWordsAreAnsweredWithASentence) {
  const auto answer = Run("--vary weather");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.text, HasSubstr("--vary: expected some of start, light"));
  EXPECT_THAT(Run("--scenario nowhere").text, HasSubstr("nowhere.toml"));
}

}  // namespace
}  // namespace priamos
