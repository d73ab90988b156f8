#pragma once

#include <string>
#include <vector>

#include "bus/own_types.hpp"
#include "planner/planner_app.hpp"

namespace priamos::planner {

/// The planner on a bus of its own, and the other end of its radio played by hand.
struct Workstation {
  explicit Workstation(const PlannerConfig& config = {}, MissionMaker missions = MakeMissions,
                       bool from_log = false)
      : follows_log(from_log), dut(config, context, missions) {}

  void Step() {
    clock.Set(clock.Now() + dut.TickPeriod());
    bus.Drain();
    dut.Tick(clock.Now());
    bus.Drain();
  }
  void Run(int ticks) {
    for (int i = 0; i < ticks; ++i) Step();
  }
  void SendLink(bool up) {
    link_status_t message{};
    message.utime = ToUtime(clock.Now());
    message.up = up;
    link.Publish(message);
  }
  void SendPose(double x_m, double vx_m_s = 0) {
    pose_t message{};
    message.utime = ToUtime(clock.Now());
    message.x_m = x_m;
    message.y_m = 2.4;
    message.vx_m_s = vx_m_s;
    message.sigma_x_m = message.sigma_y_m = 0.005;
    message.sigma_yaw_rad = 0.002;
    pose.Publish(message);
  }
  void SendOpening(double x_m) {
    opening_t message{};
    message.utime = ToUtime(clock.Now());
    message.x_m = x_m;
    message.y_m = 2.4;
    message.width_m = 0.95;
    opening.Publish(message);
  }
  void SendCorrection(int request_id) {
    pose_correction_t message{};
    message.utime = ToUtime(clock.Now());
    message.request_id = request_id;
    message.verdict = pose_correction_t::APPLIED;
    correction.Publish(message);
  }
  void SendDrive(int path_id, std::int8_t mode) {
    drive_status_t message{};
    message.utime = ToUtime(clock.Now());
    message.path_id = path_id;
    message.mode = mode;
    drive.Publish(message);
  }
  void Order(std::int8_t mission, int landmark_id = 1) {
    mission_command_t message{};
    message.utime = ToUtime(clock.Now());
    message.mission = mission;
    message.landmark_id = static_cast<std::int16_t>(landmark_id);
    order.Publish(message);
  }
  int phase() {
    for (const auto& message : statuses.Drain()) last_status = message;
    return last_status.phase;
  }

  bus::Schema schema = bus::OwnTypes();
  bus::SimulatedClock clock{FromUtime(1'000'000'000)};
  bus::LcmBus bus{"memq://"};
  bus::Node node{bus, schema, clock}, other{bus, schema, clock};
  std::vector<std::string> log;
  bool follows_log;
  bus::Context context{node, [this] {
                         bus::Surroundings around;
                         around.from_log = follows_log;
                         around.config_dir = PRIAMOS_SOURCE_DIR "/config/sim";
                         around.log = [this](bus::Level, std::string_view text) { log.emplace_back(text); };
                         return around;
                       }()};
  PlannerApp dut;
  bus::Publisher<link_status_t> link = other.Advertise(channels::kLinkStatus);
  bus::Publisher<opening_t> opening = other.Advertise(channels::kOpening);
  bus::Publisher<pose_t> pose = other.Advertise(channels::kPose);
  bus::Publisher<pose_correction_t> correction = other.Advertise(channels::kPoseCorrection);
  bus::Publisher<landmark_fix_t> fix = other.Advertise(channels::kLandmarkFix);
  bus::Publisher<drive_status_t> drive = other.Advertise(channels::kDriveStatus);
  bus::Publisher<mission_command_t> order = other.Advertise(channels::kMissionCommand);
  bus::Inbox<landmark_model_t> models = other.SubscribeAll(channels::kLandmarkModel);
  bus::Inbox<look_request_t> looks = other.SubscribeAll(channels::kLookRequest);
  bus::Inbox<path_t> paths = other.SubscribeAll(channels::kPath);
  bus::Inbox<mission_status_t> statuses = other.SubscribeAll(channels::kMissionStatus);
  mission_status_t last_status{};
};

}  // namespace priamos::planner
