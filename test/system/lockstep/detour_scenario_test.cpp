#include "test/system/lockstep/shipped_scenario.hpp"

// The shipped scenario with a box on the way to the door, from the sonars to the end of the mission.

namespace priamos::cli {
namespace {

TEST(DetourScenario, TheRobotDrivesAroundTheBoxAndThroughTheDoor) {
  ExpectPasses("detour", {4, 7, 12});
}

}  // namespace
}  // namespace priamos::cli
