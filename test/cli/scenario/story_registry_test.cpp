#include "cli/scenario/story_registry.hpp"

#include <gmock/gmock.h>

#include <set>
#include <stdexcept>

#include "common/config.hpp"
#include "stage.hpp"

namespace priamos::cli {
namespace {

TEST(Stories, HaveNamesOfTheirOwnAndSayWhatTheyAre) {
  std::set<std::string_view> names;
  for (const StoryKind& kind : Stories()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name << " twice";
    EXPECT_FALSE(kind.summary.empty()) << kind.name;
    EXPECT_EQ(FindStory(kind.name).make, kind.make) << kind.name;
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"door", "teleop"}));
  EXPECT_THROW(FindStory("dor"), std::invalid_argument);
}

TEST(Stories, EachWaitsForTheProcessesAndEndsAtTheTimeLimit) {
  for (const StoryKind& kind : Stories()) {
    Scenario scenario;
    scenario.story = kind.name;
    scenario.time_limit_s = 5;
    scenario.processes.resize(1);
    scenario.processes[0].module = "robot";
    scenario.processes[0].bus = "onboard";
    Stage stage(scenario);
    stage.Run(4);
    EXPECT_FALSE(stage.story->Started() || stage.Done()) << kind.name;
    stage.Run(2);
    EXPECT_TRUE(stage.Done()) << kind.name;
    EXPECT_FALSE(stage.story->Started() || stage.story->Succeeded()) << kind.name;
    EXPECT_FALSE(stage.story->Reason().empty()) << kind.name;
    EXPECT_EQ(stage.mice, kind.moves_mouse ? 1 : 0) << kind.name;
  }
}

TEST(Stories, UnknownNameInAScenarioIsRefusedWithItsPlaceAndTheNearestName) {
  try {
    ParseConfig<Scenario>("walk.toml", "title = \"walk\"\nstory = \"telop\"\n");
    FAIL() << "an unknown story was taken";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(
        error.what(),
        "walk.toml:2:story: expected one of corridor, door, elevator, explore, goto, locate, patrol, "
        "teleop, got \"telop\"; nearest: \"teleop\"");
  }
}

TEST(Stories, EveryNameIsTakenByAScenario) {
  for (const StoryKind& kind : Stories())
    EXPECT_EQ(ParseConfig<Scenario>(
                  "walk.toml", "story = \"" + std::string(kind.name) + "\"\n[[waypoint]]\nx_m = 1\ny_m = 2\n")
                  .story,
              kind.name);
}

}  // namespace
}  // namespace priamos::cli
