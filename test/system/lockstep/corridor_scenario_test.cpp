#include "test/system/lockstep/shipped_scenario.hpp"

// The shipped scenario of a corridor that is followed to its end, from the sonars to the outcome of the
// mission.

namespace priamos::cli {
namespace {

TEST(CorridorScenario, TheRobotFollowsItPastThingsThatAreNotOnItsPlan) {
  ExpectPasses("corridor", {1});
}

}  // namespace
}  // namespace priamos::cli
