// What a supervisor tells and obeys on its buses, with processes that are shells.

#include "cli/supervise/supervisor_control.hpp"

#include <gmock/gmock.h>

#include <set>
#include <thread>

#include "bus/own_types.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// A bus of this process with an ear for what a supervisor says.
struct Ear {
  explicit Ear(const bus::Schema& schema, const bus::Clock& clock)
      : node(bus, schema, clock),
        reports(node.SubscribeAll(channels::kProcessReport)),
        states(node.SubscribeAll(channels::kProcessState)),
        simulations(node.SubscribeAll(channels::kSimulation)),
        stops(node.SubscribeAll(channels::kEstop)),
        orders(node.Advertise(channels::kProcessOrder)) {}
  bus::LcmBus bus{"memq://"};
  bus::Node node;
  bus::Inbox<process_report_t> reports;
  bus::Inbox<process_state_t> states;
  bus::Inbox<simulation_t> simulations;
  bus::Inbox<estop_t> stops;
  bus::Publisher<process_order_t> orders;
};

class SupervisorControlTest : public testing::Test {
 protected:
  static ProcessSpec Shell(const std::string& name, const std::string& group, bool drives = false) {
    ProcessSpec spec;
    spec.name = name;
    spec.group = group;
    spec.drives = drives;
    spec.notifies = false;
    spec.arguments = {"/bin/sh", "-c", "echo here is " + name + "; exec sleep 60"};
    return spec;
  }
  /// Steps until `done`; false when it does not come.
  bool Until(const std::function<bool()>& done) {
    for (int i = 0; i < 500; ++i) {
      onboard_.bus.Drain();
      offboard_.bus.Drain();
      dut_.Step(clock_.Now());
      supervisor_.Step(clock_.Now());
      onboard_.bus.Drain();
      offboard_.bus.Drain();
      if (done()) return true;
      std::this_thread::sleep_for(milliseconds(10));
    }
    return false;
  }
  void Order(Ear& ear, std::int8_t action, const std::string& name) {
    process_order_t order{};
    order.utime = ToUtime(clock_.Now());
    order.request_id = ++number_;
    order.action = action;
    order.name = name;
    ear.orders.Publish(order);
  }
  int Starts(std::size_t process) { return supervisor_.Report()[process].starts; }

  const TemporaryFolder folder_;
  const bus::Schema schema_ = bus::OwnTypes();
  const bus::MonotonicClock clock_;
  Ear onboard_{schema_, clock_}, offboard_{schema_, clock_};
  Supervisor supervisor_{
      {Shell("onboard-robot", "onboard", true), Shell("offboard-planner", "offboard"), Shell("line", "line")},
      folder_.path().string(),
      [](const std::string&) {}};
  std::vector<std::string> begun_;
  SupervisorControl dut_{
      {{"onboard", &onboard_.node}, {"offboard", &offboard_.node}},
      supervisor_,
      {{{"door", "a door"}, {"corridor", "a corridor"}}, "door", [this](const std::string& name) {
         begun_.push_back(name);
         return true;
       }}};
  int number_ = 0;
};

TEST_F(SupervisorControlTest, TellsOnEachBusHowItsProcessesAre) {
  ASSERT_TRUE(Until([&] { return supervisor_.AllReady(); }));
  std::set<std::string> here, there;
  ASSERT_TRUE(Until([&] {
    for (const auto& state : onboard_.states.Drain())
      if (state.state == process_state_t::READY) here.insert(state.process);
    for (const auto& state : offboard_.states.Drain())
      if (state.state == process_state_t::READY) there.insert(state.process);
    return here.size() + there.size() >= 3;
  }));
  EXPECT_THAT(here, ElementsAre("onboard-robot"));
  EXPECT_THAT(there, UnorderedElementsAre("line", "offboard-planner"));
}

TEST_F(SupervisorControlTest, WhatDrivesIsStoppedBeforeItIsStartedAgain) {
  ASSERT_TRUE(Until([&] { return supervisor_.AllReady(); }));
  Order(onboard_, process_order_t::RESTART, "onboard-robot");
  std::vector<estop_t> stops;
  ASSERT_TRUE(Until([&] {
    stops = onboard_.stops.Drain();
    return !stops.empty();
  }));
  EXPECT_EQ(stops.front().action, estop_t::STOP);
  EXPECT_EQ(Starts(0), 1) << "not yet";
  EXPECT_THAT(onboard_.reports.Drain(), IsEmpty()) << "it is answered when it is ready again";
  ASSERT_TRUE(Until([&] { return Starts(0) == 2; }));
  std::vector<process_report_t> reports;
  ASSERT_TRUE(Until([&] {
    reports = onboard_.reports.Drain();
    return !reports.empty();
  }));
  EXPECT_EQ(reports.front().outcome, process_report_t::DONE);
}

TEST_F(SupervisorControlTest, OthersAreStartedAgainAtOnceAndNobodyIsStopped) {
  ASSERT_TRUE(Until([&] { return supervisor_.AllReady(); }));
  Order(offboard_, process_order_t::RESTART, "offboard-planner");
  ASSERT_TRUE(Until([&] { return Starts(1) == 2; }));
  EXPECT_THAT(onboard_.stops.Drain(), IsEmpty());
  EXPECT_THAT(offboard_.stops.Drain(), IsEmpty());
}

TEST_F(SupervisorControlTest, AnOrderIsObeyedOnTheBusOfItsProcessOnly) {
  ASSERT_TRUE(Until([&] { return supervisor_.AllReady(); }));
  Order(offboard_, process_order_t::RESTART, "onboard-robot");
  Order(onboard_, process_order_t::RESTART, "offboard-planner");
  EXPECT_FALSE(Until([&] { return Starts(0) + Starts(1) > 2; }));
  EXPECT_THAT(offboard_.reports.Drain(), IsEmpty());
}

TEST_F(SupervisorControlTest, TellsLinesOfAConsole) {
  ASSERT_TRUE(Until([&] { return supervisor_.AllReady(); }));
  std::this_thread::sleep_for(milliseconds(200));
  Order(offboard_, process_order_t::LOG, "line");
  std::vector<process_report_t> reports;
  ASSERT_TRUE(Until([&] {
    reports = offboard_.reports.Drain();
    return !reports.empty();
  }));
  EXPECT_THAT(reports.front().text, HasSubstr("here is line\n"));
  EXPECT_EQ(reports.front().begin_bytes, 0);
}

TEST_F(SupervisorControlTest, TheSimulationBeginsAnewWithWhatIsOnOffer) {
  ASSERT_TRUE(Until([&] { return supervisor_.AllReady(); }));
  Order(offboard_, process_order_t::NEW_WORLD, "moon");
  Order(onboard_, process_order_t::NEW_WORLD, "corridor");
  simulation_t newest{};
  const auto hear = [&] {
    for (const auto& message : offboard_.simulations.Drain()) newest = message;
  };
  EXPECT_FALSE(Until([&] {
    hear();
    return !begun_.empty();
  })) << "neither one that is not on offer, nor from the robot's bus";
  EXPECT_EQ(newest.scenario, "door");
  EXPECT_EQ(newest.worlds, 1);
  ASSERT_EQ(newest.scenarios.size(), 2U);
  EXPECT_EQ(newest.scenarios[1].name, "corridor");
  Order(offboard_, process_order_t::NEW_WORLD, "corridor");
  ASSERT_TRUE(Until([&] {
    hear();
    return newest.worlds == 2;
  }));
  EXPECT_THAT(begun_, ElementsAre("corridor"));
  EXPECT_EQ(newest.scenario, "corridor");
}

}  // namespace
}  // namespace priamos::cli
