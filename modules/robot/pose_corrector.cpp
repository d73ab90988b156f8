#include "robot/pose_corrector.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "robot/robot_messages.hpp"

namespace priamos::robot {
namespace {

/// Slower than this the base stands: encoders tell no less.
constexpr double kStands_m_s = 0.01, kStands_rad_s = 0.01;

}  // namespace

PoseCorrector::PoseCorrector(const RobotConfig& config, bus::Context& context)
    : max_age_s_(config.path_max_age_s),
      context_(context),
      fixes_(context.node().SubscribeAll(channels::kLandmarkFix)),
      resets_(context.node().SubscribeAll(channels::kPoseReset)),
      correction_(context.node().Advertise(channels::kPoseCorrection)) {}

void PoseCorrector::Tick(Localiser& localiser, DriveController& drive, Time now) {
  TakeFixes(localiser, now);
  AnswerFixes(localiser, now);
  TakeResets(localiser, drive, now);
}

void PoseCorrector::TakeFixes(Localiser& localiser, Time now) {
  for (const landmark_fix_t& message : fixes_.Drain()) {
    if (const auto fix = FromMessage(message)) {
      localiser.AddFix(*fix, now);
    } else {
      correction_.Publish(NotFound(message, now));
    }
  }
}

void PoseCorrector::AnswerFixes(Localiser& localiser, Time now) {
  for (const Localiser::Answer& answer : localiser.Step(now)) {
    const FixResult& result = answer.result;
    if (result.verdict == FixVerdict::kApplied) {
      context_.Log(bus::Level::kInfo,
                   fmt::format("fix {}: corrected by {:.3f} m, {:.2f} deg; distance {:.1f}",
                               answer.fix.request_id, std::hypot(result.change.x, result.change.y),
                               Degrees(result.change.yaw), result.distance));
    } else {
      context_.LogRefusal(channels::kLandmarkFix.name,
                          fmt::format("fix {} refused: {}", answer.fix.request_id, result.reason));
    }
    // A repeated message has had its answer.
    if (result.verdict != FixVerdict::kDouble) correction_.Publish(ToMessage(answer, now));
  }
}

/// An order is repeated until its answer has got through; it is obeyed once.
void PoseCorrector::TakeResets(Localiser& localiser, DriveController& drive, Time now) {
  for (const pose_reset_t& order : resets_.Drain()) {
    if (!placed_ || placed_->request_id != order.request_id) {
      Pose2 change;
      const int verdict = SetPose(order, localiser, drive, now, change);
      placed_ = AnswerTo(order, verdict, change, now);
    }
    correction_.Publish(*placed_);
  }
}

/// Obeys an order to set the pose. Returns its verdict, as in pose_correction_t, and the change of the pose.
int PoseCorrector::SetPose(const pose_reset_t& order, Localiser& localiser, DriveController& drive, Time now,
                           Pose2& change) {
  const auto refuse = [&](int verdict, std::string_view why) {
    context_.LogRefusal(channels::kPoseReset.name, fmt::format("pose {} not set: {}", order.request_id, why));
    return verdict;
  };
  const auto known = FromMessage(order);
  if (!known) return refuse(pose_correction_t::IMPLAUSIBLE, "numbers out of range");
  if (Seconds(now - FromUtime(order.utime)) > max_age_s_)
    return refuse(pose_correction_t::TOO_OLD, "the order is too old");
  const Twist2 twist = localiser.odometry().twist();
  const bool moves = std::hypot(twist.vx, twist.vy) > kStands_m_s || std::abs(twist.wz) > kStands_rad_s;
  if (moves || !drive.ForgetDrivenPath())
    return refuse(pose_correction_t::MOVING,
                  "the base drives; next: abort the mission or let go, and set it again");
  change = localiser.Reset(*known);
  context_.Log(bus::Level::kInfo,
               fmt::format("pose {} set by order: ({:.2f}, {:.2f}), {:.0f} deg, known to {:.2f} m",
                           order.request_id, known->map_from_base.x, known->map_from_base.y,
                           Degrees(known->map_from_base.yaw), known->sigma_m));
  return pose_correction_t::RESET;
}

}  // namespace priamos::robot
