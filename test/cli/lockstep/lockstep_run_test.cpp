#include "cli/lockstep/lockstep_run.hpp"

#include <gmock/gmock.h>

#include "bus/own_types.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/small_deployment.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;

class LockstepRunTest : public testing::Test {
 protected:
  LockstepResult Run(const std::string& scenario = "wait") {
    request_.deployment = deployment_.name();
    request_.scenario = scenario;
    return RunLockstep(schema_, request_);
  }
  std::string Refusal(const std::string& scenario) {
    try {
      Run(scenario);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }
  const bus::Schema schema_ = bus::OwnTypes();
  SmallDeployment deployment_;
  LockstepRequest request_;
};

TEST_F(LockstepRunTest, EndsAtTheTimeLimitOfTheScenario) {
  const LockstepResult dut = Run();
  EXPECT_NEAR(Seconds(dut.duration), 1, 0.05) << "in simulated time";
  EXPECT_FALSE(dut.summary.passed);
  EXPECT_EQ(dut.summary.scenario, "wait");
  EXPECT_GT(dut.summary.realtime_factor, 1) << "nothing has to be waited for";
}

TEST_F(LockstepRunTest, TheSeedAndTheDoorAreThoseOfTheRequest) {
  request_.seed = 42;
  const LockstepResult dut = Run();
  EXPECT_EQ(dut.summary.seed, 42u);
  EXPECT_EQ(dut.info.seed, 42u);
  EXPECT_EQ(dut.info.door.name, "laboratory");
  EXPECT_TRUE(dut.map_file.ends_with("maps/door.toml"));
  EXPECT_TRUE(dut.info.world.solids.empty()) << "no world takes part";
}

TEST_F(LockstepRunTest, WhatIsToldGoesToWhoeverFollowsAndIntoTheReport) {
  std::vector<std::string> heard;
  request_.progress = [&](Time t, const std::string& text) {
    EXPECT_LT(Seconds(t.time_since_epoch()), 2) << "since the start of the run";
    heard.push_back(text);
  };
  const LockstepResult dut = Run();
  ASSERT_EQ(heard.size(), dut.info.story.size());
  for (std::size_t i = 0; i < heard.size(); ++i) EXPECT_EQ(heard[i], dut.info.story[i].text);
}

TEST_F(LockstepRunTest, BothBusesAreTappedAndLogged) {
  const TemporaryFolder logs;
  request_.log_folder = logs.path().string();
  std::size_t tapped = 0;
  request_.tap = [&](std::string_view, Time, std::string_view, std::span<const std::byte>) { ++tapped; };
  Run();
  EXPECT_EQ(EventsOf(logs / "onboard.lcmlog").size() + EventsOf(logs / "offboard.lcmlog").size(), tapped);
}

TEST_F(LockstepRunTest, ADaemonHasNoPlaceInSimulatedTime) {
  deployment_.AddScenario("hand",
                          "story = \"teleop\"\n[[process]]\nmodule = \"spacenavd\"\nbus = \"offboard\"\n");
  EXPECT_NEAR(Seconds(Run("hand").duration), 1, 0.05);
}

TEST_F(LockstepRunTest, AnUnknownScenarioOrDoorIsRefused) {
  EXPECT_THAT(Refusal("weit"), HasSubstr("nearest: \"wait\""));
  deployment_.AddScenario("elsewhere", "");
  std::ofstream(deployment_ / "scenarios/elsewhere.toml") << "landmark_id = 77\nmap = \"maps/door.toml\"\n";
  EXPECT_THAT(Refusal("elsewhere"), HasSubstr("77"));
}

}  // namespace
}  // namespace priamos::cli
