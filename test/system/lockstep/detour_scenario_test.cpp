#include <gtest/gtest.h>

#include "bus/own_types.hpp"
#include "cli/lockstep/lockstep_run.hpp"

// The shipped scenario with a box on the way to the door, from the sonars to the end of the mission.

namespace priamos::cli {
namespace {

TEST(DetourScenario, TheRobotDrivesAroundTheBoxAndThroughTheDoor) {
  const bus::Schema schema = bus::OwnTypes();
  for (const std::uint64_t seed : {3, 7, 12}) {
    LockstepRequest request;
    request.deployment = PRIAMOS_SOURCE_DIR "/config/sim";
    request.scenario = "detour";
    request.seed = seed;
    const Summary dut = RunLockstep(schema, request).summary;
    EXPECT_TRUE(dut.passed) << "seed " << seed << ": " << dut.reason;
    EXPECT_EQ(dut.contacts, 0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace priamos::cli
