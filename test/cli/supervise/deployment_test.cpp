#include "cli/supervise/deployment.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "common/config.hpp"

namespace priamos::cli {
namespace {

using testing::Contains;
using testing::IsEmpty;

const LaunchPlace kPlace{"/opt/bin", std::string(PRIAMOS_SOURCE_DIR) + "/config/sim", "/tmp/run", 7};

Deployment Shipped(const std::string& name) {
  return LoadConfig<Deployment>(std::string(PRIAMOS_SOURCE_DIR) + "/config/" + name + "/deployment.toml");
}

const ProcessSpec& Find(const std::vector<ProcessSpec>& plan, const std::string& name) {
  for (const ProcessSpec& spec : plan)
    if (spec.name == name) return spec;
  throw std::invalid_argument(name);
}

TEST(Deployment, ShippedOnesLoadAndEveryConfigurationIsThere) {
  for (const char* name : {"sim", "robot"}) {
    const Deployment dut = Shipped(name);
    for (const ScenarioProcess& process : dut.processes)
      EXPECT_TRUE(
          std::filesystem::exists(std::string(PRIAMOS_SOURCE_DIR) + "/config/" + name + "/" + process.config))
          << name << " " << process.config;
  }
}

TEST(Deployment, ARobotHasNoSimulatedWorld) {
  for (const ScenarioProcess& process : Shipped("robot").processes) EXPECT_NE(process.module, "world");
}

TEST(Deployment, PlanNamesProgramConfigurationBusAndSeed) {
  const auto plan = PlanOf(Shipped("sim"), kPlace);
  const auto& robot = Find(plan, "onboard-robot");
  EXPECT_EQ(robot.arguments[0], "/opt/bin/priamos-robot");
  EXPECT_THAT(robot.arguments, Contains(kPlace.config_folder + "/robot.toml"));
  EXPECT_THAT(robot.arguments, Contains("7"));
  EXPECT_THAT(robot.arguments, Contains("priamos")) << "whose robot it is";
  EXPECT_THAT(robot.after, Contains("onboard-world"));
}

TEST(Deployment, RadiosWaitForTheEmulatedLine) {
  const auto plan = PlanOf(Shipped("sim"), kPlace);
  EXPECT_THAT(Find(plan, "onboard-radio").after, Contains("line"));
  EXPECT_THAT(Find(plan, "offboard-radio").arguments, Contains("/tmp/run/tty-offboard"));
}

TEST(Deployment, NoLinkOutlivesTheEmulatedLine) {
  EXPECT_THAT(Find(PlanOf(Shipped("sim"), kPlace), "line").leftovers,
              testing::UnorderedElementsAre("/tmp/run/tty-onboard", "/tmp/run/tty-offboard"));
}

TEST(Deployment, AGroupStartsOnlyItsProcessesAndWaitsForNoOthers) {
  Deployment deployment = Shipped("sim");
  deployment.emulated_line = false;
  deployment.group = "offboard";
  deployment.processes.back().after = "onboard-world";
  const auto plan = PlanOf(deployment, kPlace);
  for (const ProcessSpec& spec : plan) EXPECT_EQ(spec.group, "offboard");
  EXPECT_THAT(plan.back().after, IsEmpty());
}

TEST(Deployment, AnUnknownNameInAfterIsRefused) {
  Deployment deployment = Shipped("sim");
  deployment.processes[0].after = "nobody";
  EXPECT_THROW(Supervisor(PlanOf(deployment, kPlace), "/tmp", [](const std::string&) {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace priamos::cli
