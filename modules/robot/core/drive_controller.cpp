#include "robot/core/drive_controller.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;

// Two and a half periods: a late message is not yet silence.
constexpr milliseconds kWheelsDue{50};
constexpr milliseconds kSonarDue{250};
constexpr double kStanding = 0.01;     ///< [m/s] slower is standing
constexpr double kWantsToMove = 0.03;  ///< [m/s]
constexpr double kSlowed = 0.98;       ///< a scale below this is a limit worth telling

double SpeedOf(const Twist2& twist) {
  return std::hypot(twist.vx, twist.vy) + std::abs(twist.wz) * PathShape::kTurnLever;
}

bool SamePath(const Path& a, const Path& b) {
  const auto same = [](const Pose2& p, const Pose2& q) { return p.x == q.x && p.y == q.y && p.yaw == q.yaw; };
  return a.id == b.id && a.speed_m_s == b.speed_m_s &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same);
}

/// How long something that should have come by now has been missing.
Duration Silence(std::optional<Time> heard, Time first_step, Time now, Duration due) {
  const Duration age = now - heard.value_or(first_step);
  return !heard || age > due ? std::max(age, Duration(1)) : Duration::zero();
}

/// How long a condition with a known begin has lasted.
Duration Lasting(const std::optional<Time>& since, Time now) {
  return since ? std::max(now - *since, Duration(1)) : Duration::zero();
}

}  // namespace

void DriveConfig::Describe(Archive& a) {
  a.Number("lost_position_m", lost_position_m,
           {"m", 0.05, 5, "no path is driven by a pose with a larger sigma"});
  a.Number("lost_yaw_deg", lost_yaw_deg, {"deg", 1, 90, "the same for the heading"});
  a.Number("blocked_s", blocked_s, {"s", 0, 60, "standing before an obstacle for this long is BLOCKED"});
  a.Section("footprint", footprint, "the body of the base");
  a.Section("follower", follower, "how a path is driven");
  a.Section("acceleration", acceleration, "limits while driving");
  a.Section("braking", braking, "limits while a hold brakes the base");
  a.Section("echoes", echoes, "which sonar echoes are believed");
  a.Section("collision", collision, "the last filter before the wheels");
  a.Section("failsafe", failsafe, "when silence is too long");
}

DriveController::DriveController(const DriveConfig& config, const MecanumGeometry& geometry)
    : config_(config),
      geometry_(geometry),
      follower_(config.follower),
      slew_(config.acceleration),
      brake_(config.braking),
      echoes_(config.echoes, config.footprint),
      collision_(config.collision, config.footprint),
      failsafe_(config.failsafe) {}

void DriveController::SetPath(const Path& path) {
  const bool driving_it = path_is_new_ || follower_.has_path();
  if (driving_it && path_ && SamePath(*path_, path)) return;
  path_ = path;
  path_is_new_ = !path.points.empty();
  state_.path_id = path.id;
  if (path.points.empty()) {
    follower_.Drop();
    state_.mode = DriveMode::kHolding;
  }
}

std::optional<WheelSpeeds> DriveController::Step(const DriveSituation& situation, Time now) {
  if (!first_step_) first_step_ = now;
  const double dt_s = last_step_ ? std::clamp(Seconds(now - *last_step_), 1e-3, 0.1) : 0.02;
  last_step_ = now;
  if (echoes_.newest()) sonar_heard_ = echoes_.newest();
  echoes_.Forget(now);
  state_.failsafe = Watch(situation, now);

  Twist2 wanted;
  if (state_.failsafe.action == FailsafeAction::kNone) wanted = WantedByPath(situation, now, dt_s);
  if (state_.failsafe.action == FailsafeAction::kHalt) Halt();
  const bool braking = state_.failsafe.action != FailsafeAction::kNone || !follower_.has_path();
  TwistSlew& slew = braking ? brake_ : slew_;
  const Twist2 given = Guard(slew.Step(wanted, dt_s), situation);
  const WheelSpeeds wheels = Saturated(geometry_, ToWheelSpeeds(geometry_, given));
  const Twist2 commanded = FromWheelSpeeds(geometry_, wheels).twist;
  slew_.SetCommanded(commanded);
  brake_.SetCommanded(commanded);
  NoteBlocked(wanted, commanded, now);
  NoteStuck(situation, now);
  if (!path_) return std::nullopt;
  return wheels;
}

FailsafeDecision DriveController::Watch(const DriveSituation& situation, Time now) {
  if (!IsLost(situation)) pose_lost_since_.reset();
  if (IsLost(situation) && !pose_lost_since_) pose_lost_since_ = now;

  FailsafeInputs inputs;
  inputs.source = follower_.has_path() || path_is_new_ ? DriveSource::kPath : DriveSource::kNone;
  inputs[Condition::kWheelsSilent] = Silence(situation.wheels_heard, *first_step_, now, kWheelsDue);
  inputs[Condition::kSonarSilent] = Silence(sonar_heard_, *first_step_, now, kSonarDue);
  inputs[Condition::kPoseLost] = Lasting(pose_lost_since_, now);
  inputs[Condition::kWheelsStuck] = Lasting(stuck_since_, now);
  return failsafe_.Update(inputs, now);
}

bool DriveController::IsLost(const DriveSituation& situation) const {
  return !situation.estimate || !(situation.estimate->PositionSigma() < config_.lost_position_m) ||
         !(situation.estimate->YawSigma() < Radians(config_.lost_yaw_deg));
}

Twist2 DriveController::WantedByPath(const DriveSituation& situation, Time now, double dt_s) {
  if (!situation.estimate) return {};
  const PoseEstimate& estimate = *situation.estimate;
  // What lasts too short to stop a drive is enough not to begin one.
  if (path_is_new_ && !IsLost(situation)) {
    follower_.Follow(*path_, estimate.pose);
    path_is_new_ = false;
    state_.mode = DriveMode::kFollowing;
  }
  if (!follower_.has_path()) return {};
  const double age_s = std::clamp(Seconds(now - estimate.time), 0.0, config_.failsafe.wheels_silent_s);
  const PathFollower::Wanted wanted = follower_.Step(estimate.pose, estimate.twist, age_s, dt_s);
  state_.remaining_m = wanted.remaining_m;
  state_.cross_track_m = wanted.cross_track_m;
  if (wanted.arrived) state_.mode = DriveMode::kArrived;
  return wanted.twist;
}

Twist2 DriveController::Guard(const Twist2& smooth, const DriveSituation& situation) {
  const auto points = echoes_.Points(situation.odom_from_base);
  const CollisionStop::Result result = collision_.Limit(smooth, points);
  state_.slowed_by_sonar = result.scale < kSlowed;
  state_.nearest_m = result.free_m;
  return result.twist;
}

void DriveController::NoteBlocked(const Twist2& wanted, const Twist2& given, Time now) {
  if (state_.mode != DriveMode::kFollowing && state_.mode != DriveMode::kBlocked) return;
  const bool stopped = state_.slowed_by_sonar && SpeedOf(wanted) > kWantsToMove && SpeedOf(given) < kStanding;
  if (!stopped) blocked_since_.reset();
  if (stopped && !blocked_since_) blocked_since_ = now;
  const bool blocked = blocked_since_ && now - *blocked_since_ >= FromSeconds(config_.blocked_s);
  state_.mode = blocked ? DriveMode::kBlocked : DriveMode::kFollowing;
}

void DriveController::NoteStuck(const DriveSituation& situation, Time now) {
  const bool told_to_move = SpeedOf(slew_.commanded()) > 5 * kStanding;
  const bool stands = situation.estimate && SpeedOf(situation.estimate->twist) < kStanding;
  if (!told_to_move || !stands) stuck_since_.reset();
  if (told_to_move && stands && !stuck_since_) stuck_since_ = now;
}

void DriveController::Halt() {
  follower_.Drop();
  path_is_new_ = false;
  slew_.SetCommanded({});
  brake_.SetCommanded({});
  if (state_.mode != DriveMode::kIdle) state_.mode = DriveMode::kHolding;
}

}  // namespace priamos::robot
