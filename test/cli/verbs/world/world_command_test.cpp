#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/scenario/scenario.hpp"
#include "cli/scenario/true_world.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;

const std::string kSim = std::string(PRIAMOS_SOURCE_DIR) + "/config/sim/";

class WorldCommandTest : public testing::Test {
 protected:
  PriamosAnswer Generate(const std::string& kind, const std::string& seed,
                         std::vector<std::string> more = {}) {
    std::vector<std::string> words{"world", "generate", "--kind", kind,           "--seed",
                                   seed,    "--into",   into_,    "--deployment", kSim};
    words.insert(words.end(), more.begin(), more.end());
    return Priamos(words);
  }
  TemporaryFolder folder_;
  const std::string into_ = (folder_ / "generated").string();
};

TEST_F(WorldCommandTest, WritesAScenarioThatLoadsWithItsWorld) {
  const auto answer = Generate("room", "4");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("--scenario room-4 --seed 1"));
  const Scenario scenario = LoadScenario(into_, "room-4");
  EXPECT_EQ(scenario.map, "maps/room-4.toml");
  EXPECT_FALSE(LoadTrueWorld(into_, scenario, 1).solids.empty());
  EXPECT_TRUE(std::filesystem::exists(into_ + "/link.toml")) << "all that its processes need";
}

TEST_F(WorldCommandTest, ManySeedsAndKindsFitIntoOneFolder) {
  for (const char* kind : {"floor", "corridor", "room", "storey"})
    for (const char* seed : {"1", "2", "3"}) {
      ASSERT_EQ(Generate(kind, seed).exit_code, 0);
      const Scenario scenario = LoadScenario(into_, std::string(kind) + "-" + seed);
      for (std::uint64_t run = 1; run < 4; ++run)
        EXPECT_FALSE(LoadTrueWorld(into_, scenario, run).solids.empty()) << kind << seed;
    }
}

TEST_F(WorldCommandTest, ThereAndBackIsADriveThroughTheDoorToAPlaceAndBackToTheFirstRoom) {
  ASSERT_EQ(
      Priamos({"world", "generate", "--seed", "4", "--into", into_, "--deployment", kSim, "--there-and-back"})
          .exit_code,
      0);
  const Scenario scenario = LoadScenario(into_, "room-4");
  EXPECT_EQ(scenario.story, "goto");
  ASSERT_EQ(scenario.waypoints.size(), 2u);
  const double door_x = LoadTrueWorld(into_, scenario, 1).doors.at(0).x_m;
  EXPECT_GT(scenario.waypoints[0].x_m, door_x);
  EXPECT_LT(scenario.waypoints[1].x_m, door_x);
}

TEST_F(WorldCommandTest, TheSameSeedWritesTheSameBytes) {
  Generate("corridor", "2");
  const std::string first = FileContent(into_ + "/worlds/corridor-2.toml");
  Generate("corridor", "2", {"--force"});
  EXPECT_EQ(FileContent(into_ + "/worlds/corridor-2.toml"), first);
}

TEST_F(WorldCommandTest, AWorldThatIsThereIsReplacedOnlyByForce) {
  Generate("room", "2");
  const std::string file = into_ + "/worlds/room-2.toml";
  std::ofstream(file, std::ios::app) << "# mine\n";
  const auto answer = Generate("room", "2");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_EQ(answer.err, "priamos world generate: " + file +
                            ": expected a new world, got one that is there; --force replaces it\n");
  EXPECT_THAT(FileContent(file), HasSubstr("# mine"));
  EXPECT_EQ(Generate("room", "2", {"--force"}).exit_code, 0);
  EXPECT_THAT(FileContent(file), testing::Not(HasSubstr("# mine")));
}

TEST_F(WorldCommandTest, AFolderThatHoldsSomethingElseIsRefusedAndKept) {
  std::filesystem::create_directories(into_);
  std::ofstream(into_ + "/letter.txt") << "dear";
  const auto answer = Generate("room", "1");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("neither empty nor a deployment"));
  EXPECT_EQ(FileContent(into_ + "/letter.txt"), "dear");
}

TEST_F(WorldCommandTest, AnUnknownKindIsRefused) {
  const auto answer = Generate("tower", "1");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("--kind"));
}

TEST_F(WorldCommandTest, JsonNamesTheFiles) {
  const auto answer = Priamos({"world", "generate", "--into", into_, "--deployment", kSim, "--json"});
  EXPECT_EQ(nlohmann::json::parse(answer.out)["scenario"], "room-1");
}

TEST_F(WorldCommandTest, KeysNamesEveryKeyOfAWorldFile) {
  const auto answer = Priamos({"world", "keys"});
  EXPECT_EQ(answer.exit_code, 0);
  for (const char* key : {"[[people.waypoints]]", "[[doors.swings]]", "[[holes]]", "[[faults.sonars]]",
                          "[[faults.motors]]", "nod_deg_s2_m", "gain_spread", "yaml", "narrower_m"})
    EXPECT_THAT(answer.out, HasSubstr(key));
}

}  // namespace
}  // namespace priamos::cli
