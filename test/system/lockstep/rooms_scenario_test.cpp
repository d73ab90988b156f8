#include "test/system/lockstep/shipped_scenario.hpp"

// The shipped scenario of a drive through the door to a place in the other room, and back through the same door.

namespace priamos::cli {
namespace {

TEST(RoomsScenario, TheRobotDrivesToTheOtherRoomAndBackThroughTheDoor) {
  ExpectPasses("rooms", {3});
}

}  // namespace
}  // namespace priamos::cli
