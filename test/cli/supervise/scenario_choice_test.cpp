#include "cli/supervise/scenario_choice.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "common/config.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;

const std::string kSim = std::string(PRIAMOS_SOURCE_DIR) + "/config/sim";

Deployment Shipped(const std::string& folder) {
  return LoadConfig<Deployment>(folder + "/deployment.toml");
}

std::string SetOf(const Deployment& deployment, const std::string& module) {
  const auto& all = deployment.processes;
  return std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.module == module; })->set;
}

TEST(ScenarioChoice, TheShippedSimulationOffersWorldsAndARealRobotNone) {
  const auto offers = OfferedScenarios(Shipped(kSim), kSim);
  ASSERT_GE(offers.size(), 5U);
  EXPECT_EQ(offers.front().name, "door") << "where it begins";
  for (const auto& offer : offers) {
    EXPECT_FALSE(offer.title.empty());
    EXPECT_NO_THROW((void)InScenario(Shipped(kSim), kSim, offer.name));
  }
  const std::string robot = std::string(PRIAMOS_SOURCE_DIR) + "/config/robot";
  EXPECT_TRUE(OfferedScenarios(Shipped(robot), robot).empty());
}

TEST(ScenarioChoice, PlannerAndStationHaveTheMapOfItsWorld) {
  const auto corridor = InScenario(Shipped(kSim), kSim, "corridor");
  EXPECT_EQ(SetOf(corridor, "world"), "world=worlds/corridor.toml");
  EXPECT_EQ(SetOf(corridor, "planner"), "map=maps/corridor.toml");
  EXPECT_EQ(SetOf(corridor, "console"), "map=maps/corridor.toml");
  EXPECT_THAT(SetOf(corridor, "robot"), HasSubstr("initial="));
  EXPECT_EQ(SetOf(corridor, "radio"), "side=onboard");
  const auto explore = InScenario(Shipped(kSim), kSim, "explore");
  EXPECT_EQ(SetOf(explore, "console"), "map=maps/unknown.toml") << "what the planner has, not what is true";
  const auto by_hand = InScenario(Shipped(kSim), kSim, "teleop");
  EXPECT_EQ(SetOf(by_hand, "planner"), "map=maps/passage.toml")
      << "the scenario has no planner, a deployment has";
}

TEST(ScenarioChoice, InTheDeploymentsOwnWorldPlannerAndStationHaveTheirOwnMap) {
  const Deployment shipped = Shipped(kSim), door = InScenario(shipped, kSim, "door");
  EXPECT_EQ(SetOf(door, "planner"), SetOf(shipped, "planner"));
  EXPECT_EQ(SetOf(door, "console"), SetOf(shipped, "console"));
}

TEST(ScenarioChoice, WhatIsNotThereIsRefusedWithWhatIs) {
  EXPECT_THAT(support::ThrownReason([] { InScenario(Shipped(kSim), kSim, "corridr"); }),
              HasSubstr("corridor"));
  Deployment dut = Shipped(kSim);
  dut.scenarios = "door, moon";
  EXPECT_THAT(support::ThrownReason([&] { OfferedScenarios(dut, kSim); }), HasSubstr("\"moon\""));
}

}  // namespace
}  // namespace priamos::cli
