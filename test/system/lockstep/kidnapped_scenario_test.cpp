#include <gmock/gmock.h>

#include "test/system/lockstep/shipped_scenario.hpp"

// The shipped scenario of a robot that was carried, from the sonars to what the mission says in the end.

namespace priamos::cli {
namespace {

std::string EndOf(std::uint64_t seed) {
  const bus::Schema schema = bus::OwnTypes();
  LockstepRequest request;
  request.deployment = PRIAMOS_SOURCE_DIR "/config/sim";
  request.scenario = "kidnapped";
  request.seed = seed;
  const Summary dut = RunLockstep(schema, request).summary;
  EXPECT_EQ(dut.contacts, 0) << seed;
  return dut.reason;
}

TEST(KidnappedScenario, ADoorThatIsSeenTellsWhereTheRobotIs) {
  EXPECT_THAT(EndOf(101), testing::StartsWith("right"));
}

}  // namespace
}  // namespace priamos::cli
