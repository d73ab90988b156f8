#include <gtest/gtest.h>

#include "bus/own_types.hpp"
#include "cli/lockstep/lockstep_run.hpp"

// The shipped scenario of a drive to four places, from the sonars to the end of the last mission.

namespace priamos::cli {
namespace {

TEST(GotoScenario, TheRobotDrivesToAllPlacesAmongFurnitureThatIsNotOnItsPlan) {
  const bus::Schema schema = bus::OwnTypes();
  for (const std::uint64_t seed : {5, 7}) {
    LockstepRequest request;
    request.deployment = PRIAMOS_SOURCE_DIR "/config/sim";
    request.scenario = "goto";
    request.seed = seed;
    const Summary dut = RunLockstep(schema, request).summary;
    EXPECT_TRUE(dut.passed) << "seed " << seed << ": " << dut.reason;
    EXPECT_EQ(dut.contacts, 0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace priamos::cli
