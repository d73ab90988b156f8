#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "bus/lockstep.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/parameters/parameter_messages.hpp"
#include "cli/lockstep/factories.hpp"
#include "common/pilot/repeated_order.hpp"
#include "lcmtypes/channels.hpp"
#include "test/support/temporary_folder.hpp"

// A person at the workstation changes a parameter of the shipped robot through the shipped radio.

namespace priamos {
namespace {

using Order = parameter_order_t;
using Value = parameter_value_t;

constexpr const char* kSpeedKey = "drive.follower.shape.max_speed_m_s";

/// Both buses, and the line between the radios.
struct Buses : bus::Lockstep {
  explicit Buses(const bus::Schema& schema) : Lockstep(schema, {.seed = 1}) {
    AddBus("onboard");
    AddBus("offboard");
    AddSerialLine("tty-onboard", "tty-offboard", {});
  }
};

/// The simulated robot and the radio in lockstep, and the other end of the radio played by hand.
class ParameterRunTest : public testing::Test {
 protected:
  ParameterRunTest() {
    std::ofstream(World()) << "map = \"" << kSim << "maps/door.toml\"\n[start]\nx_m = 2.0\ny_m = 2.4\n";
    run_.AddApp(cli::FactoryFor("world"), "onboard", {kSim + "world.toml", {"world=" + World()}});
    AddRobot();
    for (const std::string side : {"onboard", "offboard"})
      run_.AddApp(cli::FactoryFor("radio"), side,
                  {kSim + "radio.toml", {"side=" + side, "port=tty-" + side}});
    Run(2);
  }

  std::string World() const { return folder_ / "world.toml"; }
  std::string Saved() const { return folder_ / "robot-parameters.toml"; }
  void AddRobot() { run_.AddApp(robot_, "onboard", {kSim + "robot.toml", {}, Saved()}); }
  void Run(double seconds) { run_.RunUntil(run_.now() + FromSeconds(seconds)); }

  void DriveTo(double x_m) {
    path_t path{};
    path.utime = ToUtime(run_.now());
    path.path_id = ++paths_ordered_;
    path.speed_m_s = 0.4;
    path.estop_changes = status_.get() ? status_.get()->estop_changes : 0;
    path.points.resize(1);
    path.points[0].x_m = x_m;
    path.points[0].y_m = 2.4;
    path.n_points = 1;
    paths_.Publish(path);
  }
  double Speed() const { return status_.get() ? status_.get()->speed_m_s : -1; }

  /// The answer that comes over the radio; nullopt when none does.
  std::optional<Value> Ask(std::int8_t action, double value = 0) {
    RepeatedOrder<Order> order;
    order.Give(bus::ToMessage({Order::ROBOT, action, number_, value}, table_, run_.now()), run_.now());
    std::optional<Value> answer;
    while (order.open()) {
      if (const auto again = order.Step(run_.now())) orders_.Publish(*again);
      Run(0.1);
      for (const Value& message : values_.Drain())
        if (order.Answered(message.request_id)) answer = message;
    }
    return answer;
  }

  const std::string kSim = PRIAMOS_SOURCE_DIR "/config/sim/";
  TemporaryFolder folder_;
  const bus::Schema schema_ = bus::OwnTypes();
  Buses run_{schema_};
  bus::AppFactory robot_ = cli::FactoryFor("robot");
  ParameterTable table_ = robot_.parameters({kSim + "robot.toml", {}}).table;
  int number_ = table_.NumberOf(kSpeedKey);
  int paths_ordered_ = 0;
  bus::Publisher<path_t> paths_ = run_.DriverNode("onboard").Advertise(channels::kPath);
  bus::Latest<drive_status_t> status_ = run_.DriverNode("onboard").Subscribe(channels::kDriveStatus);
  bus::Publisher<Order> orders_ = run_.DriverNode("offboard").Advertise(channels::kParameterOrder);
  bus::Inbox<Value> values_ = run_.DriverNode("offboard").SubscribeAll(channels::kParameterValue);
};

TEST_F(ParameterRunTest, ABaseInMotionObeysANewSpeedAndKeepsItOverARestart) {
  DriveTo(5);
  Run(3);
  EXPECT_NEAR(Speed(), 0.4, 0.03);

  const auto set = Ask(Order::SET, 0.2);
  ASSERT_TRUE(set);
  EXPECT_EQ(set->outcome, Value::DONE);
  EXPECT_EQ(bus::RoundedParameter(set->value), 0.2);
  EXPECT_TRUE(set->unsaved);
  Run(1.5);
  EXPECT_NEAR(Speed(), 0.2, 0.02) << "the path of before";

  const auto saved = Ask(Order::SAVE);
  ASSERT_TRUE(saved);
  EXPECT_EQ(saved->outcome, Value::DONE);
  EXPECT_FALSE(saved->unsaved);

  run_.RemoveApp("robot", "onboard");
  AddRobot();
  Run(1);
  DriveTo(1);
  Run(3);
  EXPECT_NEAR(Speed(), 0.2, 0.02) << "after a restart";

  const auto reset = Ask(Order::RESET);
  ASSERT_TRUE(reset);
  EXPECT_EQ(bus::RoundedParameter(reset->value), 0.6);
  EXPECT_FALSE(std::filesystem::exists(Saved()));
}

TEST_F(ParameterRunTest, WhatIsFasterThanTheFileIsRefusedThroughTheRadioToo) {
  const auto refused = Ask(Order::SET, 0.7);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->outcome, Value::LESS_CAREFUL);
  EXPECT_EQ(bus::RoundedParameter(refused->value), 0.6);
}

}  // namespace
}  // namespace priamos
