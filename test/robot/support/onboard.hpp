#pragma once

#include <cmath>
#include <optional>

#include "bus/own_types.hpp"
#include "robot/robot_app.hpp"
#include "test/robot/support/simulated_base.hpp"

namespace priamos::robot {

/// The robot on a bus of its own, with a simulated base as its drive board.
struct Onboard {
  explicit Onboard(const RobotConfig& config = {}) : dut(config, context) {}

  void Step() {
    base.Advance(std::chrono::milliseconds(20));
    clock.Set(base.now());
    if (wheels_answer) SendWheels();
    if (++ticks % 5 == 0) SendSonars();
    bus.Drain();
    dut.Tick(clock.Now());
    bus.Drain();
    if (const auto message = command.Take()) {
      last_command = *message;
      base.Command({message->speed_rad_s[0], message->speed_rad_s[1], message->speed_rad_s[2],
                    message->speed_rad_s[3]},
                   clock.Now());
    }
    if (const auto message = status.Take()) {
      last_status = *message;
      ++statuses;
    }
  }
  void Run(double seconds) {
    for (int i = 0; i < seconds * 50; ++i) Step();
  }
  void SendWheels() {
    const WheelSample sample = base.Read();
    wheel_state_t message{};
    message.utime = ToUtime(sample.time);
    std::copy(sample.ticks.begin(), sample.ticks.end(), message.position_ticks);
    wheels.Publish(message);
  }
  void SendSonars() {
    sonar_ranges_t message{};
    message.utime = ToUtime(clock.Now());
    std::fill(std::begin(message.range_m), std::end(message.range_m), -1);
    for (const int i : {5, 6, 7, 17, 18, 19}) message.range_m[i] = beside_m;
    sonars.Publish(message);
  }
  void SendPath(int id, double x_m, double speed_m_s = 0.4) {
    path_t message{};
    message.utime = ToUtime(clock.Now());
    message.path_id = id;
    message.estop_changes = last_status.estop_changes;
    message.speed_m_s = speed_m_s;
    message.points.resize(1);
    message.points[0].x_m = x_m;
    message.n_points = 1;
    paths.Publish(message);
  }
  void SendLease(int action, int session = 7, int driver = lease_request_t::TELEOP, double age_s = 0) {
    lease_request_t message{};
    message.utime = ToUtime(clock.Now() - FromSeconds(age_s));
    message.driver = static_cast<std::int8_t>(driver);
    message.session = static_cast<std::int16_t>(session);
    message.action = static_cast<std::int8_t>(action);
    leases.Publish(message);
  }
  void SendCommand(double vx_m_s, int session = 7, double age_s = 0) {
    drive_command_t message{};
    message.utime = ToUtime(clock.Now() - FromSeconds(age_s));
    message.driver = lease_request_t::TELEOP;
    message.session = static_cast<std::int16_t>(session);
    message.sequence = ++sequence;
    message.time_to_live_s = 0.2;
    message.vx_m_s = vx_m_s;
    commands.Publish(message);
  }
  void SendEstop(int action, double age_s = 0) {
    estop_t message{};
    message.utime = ToUtime(clock.Now() - FromSeconds(age_s));
    message.action = static_cast<std::int8_t>(action);
    estops.Publish(message);
  }
  /// 25 commands per second.
  void Drive(double vx_m_s, double seconds) {
    for (int i = 0; i < seconds * 50; ++i) {
      if (i % 2 == 0) SendCommand(vx_m_s);
      Step();
    }
  }
  /// The verdict on an order to set the pose to (4, 1), heading 1.
  int VerdictOnPose(double x_m = 4, double age_s = 0) {
    pose_reset_t message{};
    message.utime = ToUtime(clock.Now() - FromSeconds(age_s));
    message.request_id = ++poses;
    message.x_m = x_m;
    message.y_m = 1;
    message.yaw_rad = 1;
    message.sigma_m = 0.1;
    message.sigma_yaw_rad = 0.05;
    corrections.Drain();
    for (int i = 0; i < 2; ++i) pose_resets.Publish(message);  // said again, before the answer was there
    Step();
    const auto answers = corrections.Drain();
    const bool same = answers.size() == 2 && answers[0].utime == answers[1].utime;
    return same && answers[0].request_id == poses ? answers[0].verdict : -1;
  }
  landmark_fix_t Fix(int id) {
    const Pose2 seen = base.truth().Inverse() * Pose2{6, 0, 0};
    landmark_fix_t message{};
    message.utime_exposure = ToUtime(clock.Now());
    message.request_id = id;
    message.x_m = seen.x;
    message.y_m = seen.y;
    message.yaw_rad = seen.yaw;
    message.sigma_x_m = message.sigma_y_m = 0.01;
    message.sigma_yaw_rad = 0.005;
    message.model_x_m = 6;
    return message;
  }

  bool wheels_answer = true;
  double beside_m = -1;  ///< range of the sonars abeam
  int ticks = 0, statuses = 0, sequence = 0, poses = 8;
  SimulatedBase base{1, {0.05, 0.1, 0.02}};
  bus::Schema schema = bus::OwnTypes();
  bus::SimulatedClock clock{base.now()};
  bus::LcmBus bus{"memq://"};
  bus::Node node{bus, schema, clock}, other{bus, schema, clock};
  std::vector<std::string> log;
  bus::Context context{node, [this] {
                         bus::Surroundings around;
                         around.claimant = 77;
                         around.log = [this](bus::Level, std::string_view text) { log.emplace_back(text); };
                         return around;
                       }()};
  RobotApp dut;
  bus::Publisher<wheel_state_t> wheels = other.Advertise(channels::kWheelState);
  bus::Publisher<motor_current_t> currents = other.Advertise(channels::kMotorCurrent);
  bus::Publisher<bumper_t> bumper = other.Advertise(channels::kBumper);
  bus::Publisher<sonar_ranges_t> sonars = other.Advertise(channels::kSonarRanges);
  bus::Publisher<path_t> paths = other.Advertise(channels::kPath);
  bus::Publisher<landmark_fix_t> fixes = other.Advertise(channels::kLandmarkFix);
  bus::Publisher<pose_reset_t> pose_resets = other.Advertise(channels::kPoseReset);
  bus::Publisher<lease_request_t> leases = other.Advertise(channels::kLeaseRequest);
  bus::Publisher<drive_command_t> commands = other.Advertise(channels::kDriveCommand);
  bus::Publisher<estop_t> estops = other.Advertise(channels::kEstop);
  bus::Publisher<link_status_t> links = other.Advertise(channels::kLinkStatus);
  bus::Latest<wheel_command_t> command = other.Subscribe(channels::kWheelCommand);
  bus::Inbox<opening_t> openings = other.SubscribeAll(channels::kOpening);
  bus::Latest<odometry_t> odometry = other.Subscribe(channels::kOdometry);
  bus::Latest<pose_t> pose = other.Subscribe(channels::kPose);
  bus::Latest<drive_status_t> status = other.Subscribe(channels::kDriveStatus);
  bus::Inbox<features_t> features = other.SubscribeAll(channels::kFeatures);
  bus::Publisher<features_ack_t> feature_acks = other.Advertise(channels::kFeaturesAck);
  bus::Inbox<pose_correction_t> corrections = other.SubscribeAll(channels::kPoseCorrection);
  std::optional<wheel_command_t> last_command;
  drive_status_t last_status{};
};

}  // namespace priamos::robot
