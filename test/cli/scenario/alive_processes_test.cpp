#include "cli/scenario/alive_processes.hpp"

#include <gtest/gtest.h>

#include "bus/own_types.hpp"

namespace priamos::cli {
namespace {

Scenario ThreeProcesses() {
  Scenario scenario;
  const auto add = [&](const char* module, const char* bus) {
    ScenarioProcess process;
    process.module = module;
    process.bus = bus;
    scenario.processes.push_back(process);
  };
  add("radio", "onboard");
  add("spacenavd", "offboard");
  add("radio", "offboard");
  add("planner", "offboard");
  return scenario;
}

class AliveProcessesTest : public testing::Test {
 protected:
  void Live(bus::Publisher<health_t>& health, const std::string& process) {
    health_t message{};
    message.process = process;
    health.Publish(message);
    onboard_.Drain();
    offboard_.Drain();
    dut_.Listen();
  }
  bus::Schema schema_ = bus::OwnTypes();
  bus::SimulatedClock clock_{FromUtime(1'000'000'000)};
  bus::LcmBus onboard_{"memq://"}, offboard_{"memq://"};
  bus::Node onboard_node_{onboard_, schema_, clock_}, offboard_node_{offboard_, schema_, clock_};
  bus::Node onboard_other_{onboard_, schema_, clock_}, offboard_other_{offboard_, schema_, clock_};
  bus::Publisher<health_t> here_ = onboard_other_.Advertise(channels::kHealth);
  bus::Publisher<health_t> there_ = offboard_other_.Advertise(channels::kHealth);
  AliveProcesses dut_{ThreeProcesses(), onboard_node_, offboard_node_};
};

TEST_F(AliveProcessesTest, AtFirstAllAreMissingInTheOrderOfTheScenarioButTheDaemon) {
  EXPECT_EQ(dut_.Missing(), "onboard radio, offboard radio, offboard planner");
}

TEST_F(AliveProcessesTest, AProcessCountsOnItsOwnBusOnly) {
  Live(there_, "radio");
  EXPECT_EQ(dut_.Missing(), "onboard radio, offboard planner");
  Live(here_, "planner");
  EXPECT_EQ(dut_.Missing(), "onboard radio, offboard planner") << "it is heard on the wrong bus";
}

TEST_F(AliveProcessesTest, WhenAllWereHeardNoneIsMissingAgain) {
  Live(here_, "radio");
  Live(there_, "radio");
  Live(there_, "planner");
  EXPECT_EQ(dut_.Missing(), "");
  dut_.Listen();
  EXPECT_EQ(dut_.Missing(), "") << "silence afterwards is another's business";
}

TEST_F(AliveProcessesTest, SeveralThatSpeakBetweenTwoLooksAllCount) {
  health_t message{};
  message.process = "radio";
  there_.Publish(message);
  message.process = "planner";
  there_.Publish(message);
  offboard_.Drain();
  dut_.Listen();
  EXPECT_EQ(dut_.Missing(), "onboard radio");
}

TEST_F(AliveProcessesTest, StrangersAreOfNoInterest) {
  Live(here_, "recorder");
  EXPECT_EQ(dut_.Missing(), "onboard radio, offboard radio, offboard planner");
}

}  // namespace
}  // namespace priamos::cli
