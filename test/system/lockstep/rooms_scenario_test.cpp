#include "test/system/lockstep/shipped_scenario.hpp"

// The shipped scenarios of orders with several legs: to a place in the other room and back through the same
// door, the same with a radio that is down half of the time, and a patrol that is paused and cancelled.

namespace priamos::cli {
namespace {

TEST(RoomsScenario, TheRobotDrivesToTheOtherRoomAndBackThroughTheDoor) {
  ExpectPasses("rooms", {3});
}

TEST(RoomsScenario, ARadioThatIsDownHalfOfTheTimeDelaysItAndNoMore) {
  ExpectPasses("blackout", {4});
}

TEST(RoomsScenario, APatrolIsPausedResumedAndCancelled) {
  ExpectPasses("patrol", {5});
}

}  // namespace
}  // namespace priamos::cli
