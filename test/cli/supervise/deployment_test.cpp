#include "cli/supervise/deployment.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "common/config.hpp"
#include "test/support/thrown_reason.hpp"

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

/// The robot's two computers: one drives, the other sees.
Deployment OverTwoHosts() {
  Deployment deployment = Shipped("robot");
  for (ScenarioProcess& process : deployment.processes)
    if (process.bus == "onboard") process.host = process.module == "head" ? "vision" : "base";
  deployment.processes[1].after = "onboard-robot";
  return deployment;
}

std::vector<std::string> NamesOf(const std::vector<ProcessSpec>& plan) {
  std::vector<std::string> names;
  for (const ProcessSpec& spec : plan) names.push_back(spec.name);
  return names;
}

TEST(Deployment, AHostStartsOnlyItsProcessesAndWaitsForNoOthers) {
  Deployment deployment = OverTwoHosts();
  deployment.host = "vision";
  const auto plan = PlanOf(deployment, kPlace);
  EXPECT_THAT(NamesOf(plan), testing::ElementsAre("onboard-head"));
  EXPECT_THAT(plan[0].after, IsEmpty());
  deployment.host = "base";
  EXPECT_THAT(NamesOf(PlanOf(deployment, kPlace)), testing::ElementsAre("onboard-robot", "onboard-radio"));
  deployment.host = "";
  EXPECT_EQ(PlanOf(deployment, kPlace).size(), 3U) << "without a host those of every host";
}

TEST(Deployment, AProcessWithoutAHostRunsOnEveryOne) {
  Deployment deployment = OverTwoHosts();
  deployment.processes[0].host = "";
  deployment.host = "vision";
  EXPECT_THAT(NamesOf(PlanOf(deployment, kPlace)), testing::ElementsAre("onboard-robot", "onboard-head"));
}

TEST(Deployment, TheEmulatedLineIsWhereTheRadiosAre) {
  Deployment deployment = Shipped("sim");
  for (ScenarioProcess& process : deployment.processes)
    process.host = process.module == "head" ? "vision" : "base";
  deployment.host = "vision";
  EXPECT_THAT(NamesOf(PlanOf(deployment, kPlace)), testing::ElementsAre("onboard-head"));
  deployment.host = "base";
  EXPECT_THAT(NamesOf(PlanOf(deployment, kPlace)), Contains("line"));
}

TEST(Deployment, AWrongHostIsAnsweredWithThoseThereAre) {
  Deployment deployment = OverTwoHosts();
  deployment.host = "visoin";
  EXPECT_EQ(support::ThrownReason([&] { RequireHost(deployment); }),
            "--host: expected a host of the deployment (base, vision), got \"visoin\"; nearest: \"vision\"");
  deployment.host = "vision";
  EXPECT_NO_THROW(RequireHost(deployment));
  deployment = Shipped("robot");
  EXPECT_NO_THROW(RequireHost(deployment));
  deployment.host = "vision";
  EXPECT_THAT(support::ThrownReason([&] { RequireHost(deployment); }),
              testing::HasSubstr("this deployment names no hosts, got \"vision\"; next: "));
}

TEST(Deployment, AHostHasAPlainName) {
  const auto load = [](const std::string& host) {
    ParseConfig<Deployment>(
        "a.toml",
        "[[process]]\nmodule = \"head\"\nbus = \"onboard\"\nconfig = \"h.toml\"\nhost = \"" + host + "\"\n");
  };
  EXPECT_NO_THROW(load("vision-2"));
  for (const char* wrong : {"Vision", "a b", "a-name-too-long", "b/c", "\\n"})
    EXPECT_THAT(support::ThrownReason([&] { load(wrong); }),
                testing::HasSubstr("a.toml:5:process[0].host: expected a name"))
        << wrong;
}

TEST(Deployment, RobotTtlAndNetworkReachEveryProcess) {
  const auto deployment = ParseConfig<Deployment>(
      "a.toml",
      "robot = \"hektor\"\nonboard_ttl = 1\nonboard_network = \"eth1\"\n"
      "[[process]]\nmodule = \"head\"\nbus = \"onboard\"\nconfig = \"head.toml\"\n"
      "[[process]]\nmodule = \"planner\"\nbus = \"offboard\"\nconfig = \"planner.toml\"\n");
  const auto plan = PlanOf(deployment, kPlace);
  EXPECT_EQ(deployment.OnboardUrl(), bus::BusUrl("hektor", bus::BusSide::kOnboard, 1) + "&network=eth1");
  EXPECT_THAT(plan[0].arguments, testing::IsSupersetOf({deployment.OnboardUrl(), std::string("--network"),
                                                        std::string("eth1")}));
  EXPECT_EQ(deployment.OffboardUrl(), bus::BusUrl("hektor", bus::BusSide::kOffboard, 0));
  EXPECT_THAT(plan[1].arguments, testing::Not(Contains("--network")));
}

TEST(Deployment, AnUnknownNameInAfterIsRefused) {
  Deployment deployment = Shipped("sim");
  deployment.processes[0].after = "nobody";
  EXPECT_THROW(Supervisor(PlanOf(deployment, kPlace), "/tmp", [](const std::string&) {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace priamos::cli
