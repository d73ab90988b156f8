#include "cli/lockstep/lockstep_run.hpp"

#include <gtest/gtest.h>

#include "bus/own_types.hpp"
#include "test/cli/small_deployment.hpp"

namespace priamos::cli {
namespace {

TEST(LockstepRun, ADaemonOfTheScenarioIsNotStarted) {
  SmallDeployment deployment;
  deployment.AddScenario("mouse", "[[process]]\nmodule = \"spacenavd\"\nbus = \"offboard\"\n");
  LockstepRequest request;
  request.deployment = deployment.name();
  request.scenario = "mouse";
  const auto dut = RunLockstep(bus::OwnTypes(), request);
  EXPECT_NEAR(Seconds(dut.duration), 1, 0.1);
  EXPECT_FALSE(dut.summary.passed);
}

}  // namespace
}  // namespace priamos::cli
