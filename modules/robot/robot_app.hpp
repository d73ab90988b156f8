#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bus/context.hpp"
#include "common/rate_limit.hpp"
#include "lcmtypes/channels.hpp"
#include "robot/core/safety/link_watch.hpp"
#include "robot/drive_reporter.hpp"
#include "robot/estop_memory.hpp"
#include "robot/feature_reporter.hpp"
#include "robot/pose_corrector.hpp"
#include "robot/robot_config.hpp"
#include "robot/robot_messages.hpp"

namespace priamos::robot {

/// The first of the robot's two computers: drive, odometry, sonars, pose. See README.md.
class RobotApp {
 public:
  static constexpr std::string_view kName = "robot";
  static constexpr std::string_view kSummary =
      "The mobile base: follows paths on four Mecanum wheels, knows its pose, stops before obstacles.";
  static constexpr bool kOneOwner = true;
  using Config = RobotConfig;

  RobotApp(const RobotConfig& config, bus::Context& context);

  ~RobotApp();
  RobotApp(const RobotApp&) = delete;
  RobotApp& operator=(const RobotApp&) = delete;

  Duration TickPeriod() const { return FromSeconds(1 / config_.rate_hz); }
  void Tick(Time now);
  /// Takes over the parameters that RobotConfig marks as live.
  void Reconfigure(const RobotConfig& config) { drive_.Reconfigure(config.drive); }
  /// Sends a last command, to stand, because another process drives this base.
  void Yield(Time now);

 private:
  void TakeWheels(Time now);
  void TakeTouchSensors(Time now);
  void MapSonars(Time now);
  void TakeSonars();
  void TakeFloorLines(Time now);
  void TakeSeenThings();
  void TakePaths(Time now);
  void TakePlanWalls();
  void Begin(Time now);
  void TakeEstops(Time now);
  void Rearm();
  void KeepEstop(Time now);
  void TakeLeaseRequests(Time now);
  void TakeCommands(Time now);
  void TakeSignsOfLife(Time now);
  bool IsOlder(std::int64_t utime, double most_s, Time now) const;
  void Drive(Time now);
  void SendStatus(Time now);
  void SendOpening(Time now);
  void ReportTouch(Time now);

  RobotConfig config_;
  bus::Context& context_;
  EstopMemory estop_memory_;
  bool running_ = false, commands_wheels_ = false;
  LinkWatch link_watch_;
  RateLimit status_rate_, opening_rate_;
  Localiser localiser_;
  DriveController drive_;
  OpeningWatch opening_watch_;
  FeatureReporter features_;
  std::optional<SonarCycle> to_map_;  ///< heard in the last step
  PoseCorrector corrector_;
  DriveReporter reporter_;
  std::optional<Opening> passed_;  ///< newest

  bus::Inbox<wheel_state_t> wheels_;
  bus::Inbox<motor_current_t> currents_;
  bus::Inbox<bumper_t> bumper_;
  bus::Latest<sonar_ranges_t> sonars_;
  bus::Inbox<obstacle_line_t> floor_lines_;
  bus::Inbox<scene_object_t> things_;
  bus::Inbox<path_t> paths_;
  bus::Inbox<plan_walls_t> plan_walls_;
  bus::Inbox<drive_command_t> commands_;
  bus::Inbox<lease_request_t> lease_requests_;
  bus::Inbox<estop_t> estops_;
  bus::Inbox<health_t> healths_;
  bus::Latest<link_status_t> link_;
  bus::Publisher<wheel_command_t> wheel_command_;
  bus::Publisher<odometry_t> odometry_;
  bus::Publisher<pose_t> pose_;
  bus::Publisher<drive_status_t> status_;
  bus::Publisher<opening_t> opening_;

  std::optional<Time> wheels_heard_, head_heard_;
  int floor_lines_refused_ = 0;
};

}  // namespace priamos::robot
