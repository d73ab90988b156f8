#include <gmock/gmock.h>

#include "test/system/lockstep/shipped_scenario.hpp"

// The shipped scenario of a robot that was carried, from the sonars to what the mission says in the end.

namespace priamos::cli {
namespace {

TEST(KidnappedScenario, NoWrongPlaceIsBelievedAndNothingIsTouched) {
  const bus::Schema schema = bus::OwnTypes();
  for (const std::uint64_t seed : {101U, 104U}) {
    LockstepRequest request;
    request.deployment = PRIAMOS_SOURCE_DIR "/config/sim";
    request.scenario = "kidnapped";
    request.seed = seed;
    const Summary dut = RunLockstep(schema, request).summary;
    EXPECT_THAT(dut.reason, testing::AnyOf(testing::StartsWith("right"), testing::StartsWith("ambiguous")))
        << seed;
    EXPECT_EQ(dut.contacts, 0) << seed;
  }
}

}  // namespace
}  // namespace priamos::cli
