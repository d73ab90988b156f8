#include <gtest/gtest.h>

#include "bus/own_types.hpp"
#include "cli/lockstep_run.hpp"

// An operator's hand, the space-mouse, teleop, the radio, the robot and its world, in one process.

namespace priamos::cli {
namespace {

LockstepResult RunScenario(const std::string& scenario, std::uint64_t seed) {
  const bus::Schema schema = bus::OwnTypes();
  LockstepRequest request;
  request.deployment = std::string(PRIAMOS_SOURCE_DIR) + "/config/sim";
  request.scenario = scenario;
  request.seed = seed;
  return RunLockstep(schema, request);
}

TEST(TeleopRun, RoundTheCartonAndThroughThePassageByHand) {
  const auto dut = RunScenario("teleop", 1);
  EXPECT_TRUE(dut.summary.passed) << dut.reason;
  EXPECT_EQ(dut.summary.contacts, 0);
  EXPECT_GT(dut.summary.min_gap_m, 0);
}

TEST(TeleopRun, AMonkeyAtTheStickTouchesNothingAndIsObeyed) {
  const auto dut = RunScenario("monkey", 1);
  EXPECT_TRUE(dut.summary.passed) << dut.reason;
  EXPECT_EQ(dut.summary.contacts, 0);
  EXPECT_GT(dut.honour.asked, 300);
  EXPECT_GT(dut.honour.share(), 0.9);
}

}  // namespace
}  // namespace priamos::cli
