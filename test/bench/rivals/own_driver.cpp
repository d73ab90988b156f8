#include "test/bench/rivals/own_driver.hpp"

#include <algorithm>

#include "bus/own_types.hpp"
#include "common/config.hpp"
#include "lcmtypes/channels.hpp"
#include "robot/robot_app.hpp"
#include "test/bench/rivals/replanning.hpp"
#include "world/world_messages.hpp"

namespace priamos::bench {
namespace {

constexpr int kFirstSteps = 15;  ///< 0.3 s: a pose comes first

robot::RobotConfig ConfigFor(const Order& order, const std::string& deployment) {
  auto config = LoadConfig<robot::RobotConfig>(deployment + "/robot.toml");
  config.localiser.estimator.initial = {.x_m = order.start.x,
                                        .y_m = order.start.y,
                                        .yaw_deg = Degrees(order.start.yaw),
                                        .position_error_m = 0.02,
                                        .yaw_error_deg = 0.5};
  return config;
}

path_t MessageOf(const robot::Path& path, int estop_changes, Time now) {
  path_t message{};
  message.utime = ToUtime(now);
  message.path_id = path.id;
  message.estop_changes = static_cast<std::int16_t>(estop_changes);
  message.speed_m_s = path.speed_m_s;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Leeway leeway = i < path.leeway.size() ? path.leeway[i] : Leeway{};
    message.points.push_back(
        {path.points[i].x, path.points[i].y, path.points[i].yaw, leeway.left_m, leeway.right_m});
  }
  message.n_points = static_cast<std::int8_t>(message.points.size());
  return message;
}

const bus::Schema& Types() {
  static const bus::Schema types = bus::OwnTypes();
  return types;
}

class RobotDriver : public Driver {
 public:
  RobotDriver(const Order& order, const std::string& deployment, bool replans)
      : path_(order.path),
        replanning_(order),
        replans_(replans),
        app_(ConfigFor(order, deployment), context_) {}

  std::optional<world::PerWheel> Step(const Heard& heard, Time now) override {
    clock_.Set(now);
    Send(heard);
    if (++steps_ == kFirstSteps) paths_.Publish(MessageOf(path_, status_.get()->estop_changes, now));
    bus_.Drain();
    app_.Tick(now);
    bus_.Drain();
    if (replans_) Replan(now);
    const auto command = command_.Take();
    if (!command) return std::nullopt;
    return world::FromMessage(*command);
  }

 private:
  void Replan(Time now) {
    const pose_t* pose = pose_.get();
    if (!status_.get() || !pose) return;
    const auto path = replanning_.Next(*status_.get(), {pose->x_m, pose->y_m, pose->yaw_rad}, now);
    if (path) paths_.Publish(MessageOf(*path, status_.get()->estop_changes, now));
  }
  void Send(const Heard& heard) {
    if (heard.wheels) wheels_.Publish(world::ToMessage(*heard.wheels));
    if (heard.sonars) sonars_.Publish(world::ToMessage(*heard.sonars));
    if (!heard.touch) return;
    currents_.Publish(world::CurrentsOf(*heard.touch));
    bumper_.Publish(world::BumperOf(*heard.touch));
  }
  static bus::Surroundings Around() {
    bus::Surroundings around;
    around.claimant = 1;
    around.lockstep = true;
    around.log = [](bus::Level, std::string_view) {};
    return around;
  }

  robot::Path path_;
  Replanning replanning_;
  bool replans_;
  bus::SimulatedClock clock_{FromUtime(1'000'000'000)};
  bus::LcmBus bus_{"memq://"};
  bus::Node node_{bus_, Types(), clock_}, other_{bus_, Types(), clock_};
  bus::Context context_{node_, Around()};
  robot::RobotApp app_;
  bus::Publisher<wheel_state_t> wheels_ = other_.Advertise(channels::kWheelState);
  bus::Publisher<motor_current_t> currents_ = other_.Advertise(channels::kMotorCurrent);
  bus::Publisher<bumper_t> bumper_ = other_.Advertise(channels::kBumper);
  bus::Publisher<sonar_ranges_t> sonars_ = other_.Advertise(channels::kSonarRanges);
  bus::Publisher<path_t> paths_ = other_.Advertise(channels::kPath);
  bus::Latest<wheel_command_t> command_ = other_.Subscribe(channels::kWheelCommand);
  bus::Latest<drive_status_t> status_ = other_.Subscribe(channels::kDriveStatus);
  bus::Latest<pose_t> pose_ = other_.Subscribe(channels::kPose);
  int steps_ = 0;
};

}  // namespace

std::unique_ptr<Driver> OwnDriver(const Order& order, const std::string& deployment, bool replans) {
  return std::make_unique<RobotDriver>(order, deployment, replans);
}

}  // namespace priamos::bench
