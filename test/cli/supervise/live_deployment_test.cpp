#include "cli/supervise/live_deployment.hpp"

#include <gmock/gmock.h>

#include "cli/supervise/up_state.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::IsEmpty;

class LiveDeployment : public testing::Test {
 protected:
  LiveDeployment() {
    UpState state;
    state.config_folder = "/opt/hall/config";
    state.planner_set = "map=maps/explore.toml";
    WriteUpState(logs_.path(), state);
  }
  TemporaryFolder logs_;
};

TEST_F(LiveDeployment, WithoutANameItIsTheOneThatIsUpInItsScenario) {
  const UpLock up(logs_.path());
  UpState state;
  state.config_folder = "/opt/hall/config";
  state.planner_set = "map=maps/explore.toml";
  WriteUpState(logs_.path(), state);
  const ConfigSource dut = PlannerInUse("", logs_.path());
  EXPECT_EQ(dut.path, "/opt/hall/config/planner.toml");
  EXPECT_THAT(dut.overrides, ElementsAre("map=maps/explore.toml"));
}

TEST_F(LiveDeployment, WhatIsLeftOfOneThatWasKilledDoesNotCount) {
  const ConfigSource dut = PlannerInUse("", logs_.path());
  EXPECT_THAT(dut.path, EndsWith("/sim/planner.toml"));
  EXPECT_THAT(dut.overrides, IsEmpty());
}

TEST_F(LiveDeployment, ANameCountsBeforeWhatIsUp) {
  const UpLock up(logs_.path());
  EXPECT_THAT(PlannerInUse("robot", logs_.path()).path, EndsWith("/robot/planner.toml"));
}

TEST_F(LiveDeployment, AnUnknownNameIsRefused) {
  EXPECT_THROW(PlannerInUse("simm", logs_.path()), ConfigError);
}

}  // namespace
}  // namespace priamos::cli
