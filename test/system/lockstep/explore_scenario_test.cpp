#include <gtest/gtest.h>

#include "bus/own_types.hpp"
#include "cli/lockstep/lockstep_run.hpp"

// The shipped floor of which nobody has a plan, from the sonars to the outcome of the mission.

namespace priamos::cli {
namespace {

TEST(ExploreScenario, TheWholeFloorIsSeenWithoutAPlan) {
  const auto schema = bus::OwnTypes();
  LockstepRequest request;
  request.scenario = "explore";
  request.deployment = PRIAMOS_SOURCE_DIR "/config/sim";
  request.seed = 1;
  const Summary summary = RunLockstep(schema, request).summary;
  EXPECT_TRUE(summary.passed) << summary.reason;
  EXPECT_EQ(summary.contacts, 0);
  ASSERT_TRUE(summary.explore);
  EXPECT_GE(summary.explore->seen, 0.98) << summary.explore->end;
  EXPECT_LE(summary.explore->wall_error_p95_m, 0.20) << "the pose drifts";
}

}  // namespace
}  // namespace priamos::cli
