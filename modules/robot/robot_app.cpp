#include "robot/robot_app.hpp"

#include <fmt/format.h>

#include <cmath>

namespace priamos::robot {

RobotApp::RobotApp(const RobotConfig& config, bus::Context& context)
    : config_(config),
      context_(context),
      localiser_(config.localiser, config.base),
      drive_(config.drive, config.base),
      wheels_(context.node().SubscribeAll(channels::kWheelState)),
      sonars_(context.node().Subscribe(channels::kSonarRanges)),
      paths_(context.node().SubscribeAll(channels::kPath)),
      fixes_(context.node().SubscribeAll(channels::kLandmarkFix)),
      wheel_command_(context.node().Advertise(channels::kWheelCommand)),
      odometry_(context.node().Advertise(channels::kOdometry)),
      pose_(context.node().Advertise(channels::kPose)),
      status_(context.node().Advertise(channels::kDriveStatus)),
      correction_(context.node().Advertise(channels::kPoseCorrection)) {}

void RobotApp::Tick(Time now) {
  TakeWheels(now);
  TakeSonars();
  TakeFixes(now);
  AnswerFixes(now);
  TakePaths();
  Drive(now);
  SendStatus(now);
}

void RobotApp::TakeWheels(Time now) {
  bool moved = false;
  for (const wheel_state_t& message : wheels_.Drain()) {
    if (!localiser_.AddWheels(FromMessage(message), now)) continue;
    wheels_heard_ = now;
    moved = true;
  }
  if (moved) odometry_.Publish(ToMessage(localiser_.odometry()));
}

void RobotApp::TakeSonars() {
  if (const auto message = sonars_.Take())
    drive_.AddSonar(FromMessage(*message), localiser_.odometry().pose());
}

void RobotApp::TakeFixes(Time now) {
  for (const landmark_fix_t& message : fixes_.Drain()) {
    if (const auto fix = FromMessage(message)) {
      localiser_.AddFix(*fix, now);
    } else {
      correction_.Publish(NotFound(message, now));
    }
  }
}

void RobotApp::AnswerFixes(Time now) {
  for (const Localiser::Answer& answer : localiser_.Step(now)) {
    const FixResult& result = answer.result;
    if (result.verdict == FixVerdict::kApplied) {
      context_.Log(bus::Level::kInfo,
                   fmt::format("fix {}: corrected by {:.3f} m, {:.2f} deg; distance {:.1f}",
                               answer.fix.request_id, std::hypot(result.change.x, result.change.y),
                               Degrees(result.change.yaw), result.distance));
    } else {
      context_.Log(bus::Level::kWarning,
                   fmt::format("fix {} refused: {}", answer.fix.request_id, result.reason));
    }
    // A repeated message has had its answer.
    if (result.verdict != FixVerdict::kDouble) correction_.Publish(ToMessage(answer, now));
  }
}

void RobotApp::TakePaths() {
  for (const path_t& message : paths_.Drain()) {
    if (const auto path = FromMessage(message)) {
      drive_.SetPath(*path);
    } else {
      context_.Log(bus::Level::kWarning, fmt::format("path {} refused: not drivable", message.path_id));
    }
  }
}

void RobotApp::Drive(Time now) {
  const auto estimate = localiser_.estimate();
  const auto speeds = drive_.Step({estimate, localiser_.odometry().pose(), wheels_heard_}, now);
  if (speeds) wheel_command_.Publish(ToMessage(*speeds, now));
  if (estimate) pose_.Publish(ToMessage(*estimate));
  Tell(drive_.state().failsafe);
}

void RobotApp::SendStatus(Time now) {
  if (status_sent_ && Seconds(now - *status_sent_) < 1 / config_.status_rate_hz - 1e-6) return;
  status_sent_ = now;
  const auto estimate = localiser_.estimate();
  const double speed_m_s = estimate ? std::hypot(estimate->twist.vx, estimate->twist.vy) : 0;
  status_.Publish(ToMessage(drive_.state(), speed_m_s, now));
}

void RobotApp::Tell(const FailsafeDecision& decision) {
  if (decision.cause == told_) return;
  told_ = decision.cause;
  if (!decision.cause) {
    context_.SetHealth(bus::Health::kOk);
    context_.Log(bus::Level::kInfo, "nothing stops the base any more");
    return;
  }
  const std::string_view text = Text(*decision.cause);
  context_.SetHealth(bus::Health::kDegraded, text);
  context_.Log(bus::Level::kWarning, fmt::format("the base is stopped: {}", text));
}

}  // namespace priamos::robot
