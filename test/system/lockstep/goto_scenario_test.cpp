#include "test/system/lockstep/shipped_scenario.hpp"

// The shipped scenario of a drive to four places, from the sonars to the end of the last mission.

namespace priamos::cli {
namespace {

TEST(GotoScenario, TheRobotDrivesToAllPlacesAmongFurnitureThatIsNotOnItsPlan) {
  ExpectPasses("goto", {5, 7});
}

}  // namespace
}  // namespace priamos::cli
