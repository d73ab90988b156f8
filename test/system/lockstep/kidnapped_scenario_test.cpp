#include "test/system/lockstep/shipped_scenario.hpp"

// The shipped scenario of a robot that was carried, from the sonars to the door that tells where it is.

namespace priamos::cli {
namespace {

TEST(KidnappedScenario, TheRobotFindsOutWhereItIs) {
  ExpectPasses("kidnapped", {1});
}

}  // namespace
}  // namespace priamos::cli
