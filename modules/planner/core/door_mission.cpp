#include "planner/core/door_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

/// A pose older than this is not planned with.
constexpr double kFreshPoseS = 1.0;
/// The robot's stamps are rounded to 10 ms on the radio: a pose must be this much younger than a correction
/// to surely contain it.
constexpr Duration kStampRounding = std::chrono::milliseconds(30);
/// Share of the ordered speed from which on the base counts as driving.
constexpr double kAtSpeed = 0.8;
/// Waiting longer for the speed than this would cost more way than it is worth.
constexpr double kStartS = 3.0;
/// Path and request numbers as the messages carry them.
constexpr int kIds = 65535;

}  // namespace

void DoorMissionConfig::Describe(Archive& a) {
  a.Number("speed_m_s", speed_m_s, {"m/s", 0.05, 1, "on the approach and through the door"});
  a.Number("slowest_m_s", slowest_m_s, {"m/s", 0.05, 1, "on a short approach"});
  if (slowest_m_s > speed_m_s) a.Refuse("slowest_m_s", "at most speed_m_s");
  a.Number("look_from_m", look_from_m, {"m", 1.5, 10, "way to the door from which on the head may look"});
  a.Number("look_to_m", look_to_m, {"m", 1, 10, "way to the door at which both looks should be done"});
  if (look_to_m > look_from_m) a.Refuse("look_to_m", "at most look_from_m");
  a.Number("looks_take_s", looks_take_s, {"s", 0.5, 60, "both looks, starting and radio included"});
  a.Number("confirm_to_m", confirm_to_m,
           {"m", 0, 10, "way to the door down to which looks go on while passing"});
  a.Number("tracking_m", tracking_m, {"m", 0, 0.1, "what the path following may deviate in the door"});
  a.Number("command_delay_s", command_delay_s, {"s", 0, 2, "from a decision here to the wheels there"});
  a.Number("resend_path_s", resend_path_s, {"s", 1, 60, "a path not confirmed by then is sent again"});
  a.Number("blocked_s", blocked_s, {"s", 1, 600, "standing before an obstacle that ends the mission"});
  a.Number("silent_s", silent_s, {"s", 1, 600, "silence of the robot that ends the mission"});
  a.Number("limit_s", limit_s, {"s", 5, 3600, "time for the whole mission"});
  a.Section("look", look, "looks at the sides of the door");
  a.Section("drift", drift, "what the wheels add on the way to the door");
}

DoorMission::DoorMission(const DoorMissionConfig& config, const DoorPlannerConfig& planner,
                         const Footprint& footprint, const GroundPlan& plan)
    : config_(config),
      planner_(planner, footprint, plan),
      footprint_(footprint),
      plan_(plan),
      looks_(config.look) {}

bool DoorMission::Start(Time now, int door_id) {
  if (running()) return false;
  door_ = plan_.FindDoor(door_id);
  started_ = entered_ = now;
  blocked_since_.reset();
  corrected_.reset();
  aborted_ = judge_ = false;
  looks_.Reset();
  // Numbers go on from the clock, so that an answer meant for an earlier planner process is not taken for
  // ours.
  if (last_id_ == 0) last_id_ = 1 + static_cast<int>(ToUtime(now) / 1'000'000 % kIds);
  Enter(Phase::kWaiting, "waiting for the robot's pose");
  if (!door_) Enter(Phase::kFailed, fmt::format("the map has no door {}", door_id));
  return true;
}

void DoorMission::Abort(Time) {
  aborted_ = running();
}

void DoorMission::OnPose(const RobotPose& pose) {
  if (!pose_ || pose.stamp > pose_->stamp) pose_ = pose;
}

void DoorMission::OnDrive(const DriveReport& drive, Time now) {
  drive_ = drive;
  const bool stands = drive.mode == DriveMode::kBlocked || drive.mode == DriveMode::kHolding;
  const bool on_our_path = running() && drive.path_id == path_.path_id;
  if (!stands || !on_our_path) {
    blocked_since_.reset();
  } else if (!blocked_since_) {
    blocked_since_ = now;
  }
}

void DoorMission::Enter(Phase phase, std::string text) {
  state_ = {phase, std::move(text)};
}

void DoorMission::Fail(std::string reason, MissionActions& actions) {
  Enter(Phase::kFailed, std::move(reason));
  last_id_ = last_id_ % kIds + 1;
  path_ = {last_id_, 0, {}};
  actions = {};
  actions.path = path_;
}

MissionActions DoorMission::Tick(Time now) {
  MissionActions actions;
  if (!running() || !CheckLimits(now, actions)) return actions;
  switch (state_.phase) {
    case Phase::kWaiting:
      Wait(now, actions);
      break;
    case Phase::kApproaching:
      Approach(now, actions);
      break;
    case Phase::kLookingLeft:
    case Phase::kLookingRight:
      LookAtDoor(now, actions);
      break;
    case Phase::kPassing:
      Pass(now, actions);
      break;
    case Phase::kDone:
    case Phase::kFailed:
      break;
  }
  if (running()) RepeatUnconfirmedPath(now, actions);
  return actions;
}

bool DoorMission::CheckLimits(Time now, MissionActions& actions) {
  const Time heard = pose_ ? std::max(pose_->stamp, started_) : started_;
  if (aborted_) {
    Fail("aborted by the operator", actions);
  } else if (drive_ && drive_->estop) {
    // Not to be waited for: what moves after the re-arming is for a person to order anew.
    Fail("the emergency stop is latched; next: priamos estop --rearm, and a new order", actions);
  } else if (Seconds(now - heard) > config_.silent_s) {
    Fail(fmt::format("no pose from the robot for {:.0f} s: the radio link is {}", config_.silent_s,
                     link_up_ ? "up, is the robot running?" : "down"),
         actions);
  } else if (Seconds(now - started_) > config_.limit_s) {
    Fail(fmt::format("not through the door after {:.0f} s", config_.limit_s), actions);
  } else if (blocked_since_ && Seconds(now - *blocked_since_) > config_.blocked_s) {
    const bool blocked = drive_->mode == DriveMode::kBlocked;
    Fail(fmt::format("the robot {} for {:.0f} s{}", blocked ? "was blocked" : "held its place",
                     config_.blocked_s, drive_->limit.empty() ? "" : ": " + drive_->limit),
         actions);
  }
  return running();
}

void DoorMission::Wait(Time now, MissionActions& actions) {
  if (!link_up_ || !pose_ || Seconds(now - pose_->stamp) > kFreshPoseS) return;
  if (auto reason = planner_.RefuseDoor(*door_); !reason.empty()) return Fail(std::move(reason), actions);
  const DoorPath path = planner_.PlanApproach(*door_, pose_->map_from_base);
  if (!path.ok()) return Fail(path.refusal, actions);
  actions.model = MakeDoorLandmark(*door_);
  const double speed_m_s = ApproachSpeed(WayToDoor());
  SendPath(path.points, speed_m_s, now, actions);
  entered_ = now;
  Enter(Phase::kApproaching, fmt::format("approaching door '{}', {:.1f} m away, at {:.2f} m/s", door_->name,
                                         WayToDoor(), speed_m_s));
}

void DoorMission::Approach(Time now, MissionActions& actions) {
  if (WayToDoor() > config_.look_from_m) return;
  // A robot that stands sees just as well, but the point of one stereo pair is not to stand: let it get
  // going.
  const double speed_m_s = std::hypot(pose_->velocity.vx, pose_->velocity.vy);
  const bool waited = Seconds(now - entered_) > kStartS;
  if (speed_m_s < kAtSpeed * path_.speed_m_s && !waited) return;
  AskLook(now, actions);
}

void DoorMission::AskLook(Time now, MissionActions& actions) {
  const Side side = looks_.next();
  last_id_ = last_id_ % kIds + 1;
  looks_.Asked(last_id_, now);
  actions.look = LookOrder{last_id_, door_->id, side};
  if (state_.phase == Phase::kPassing) return;
  Enter(side == Side::kLeft ? Phase::kLookingLeft : Phase::kLookingRight,
        fmt::format("looking at the {} side of the door, {:.1f} m away", NameOf(side), WayToDoor()));
}

bool DoorMission::SettleLook(Time now, MissionActions& actions) {
  const auto result = looks_.Settle(now);
  if (!result) return false;
  if (!result->ok && result->no_model) actions.model = MakeDoorLandmark(*door_);
  return result->ok;
}

void DoorMission::LookAtDoor(Time now, MissionActions& actions) {
  const int failures = looks_.failures();
  if (SettleLook(now, actions)) judge_ = looks_.Enough();
  if (looks_.failures() > failures) Enter(state_.phase, looks_.trouble());
  if (judge_ && PoseIsCorrected(now)) {
    judge_ = false;
    EvaluatePose(now, actions);
  }
  const bool looking = state_.phase == Phase::kLookingLeft || state_.phase == Phase::kLookingRight;
  if (!looking || !looks_.Ready(now)) return;
  if (!looks_.Exhausted()) return AskLook(now, actions);
  if (!judge_)
    Fail(fmt::format("{} looks failed, the last one: {}", looks_.failures(), looks_.trouble()), actions);
}

bool DoorMission::PoseIsCorrected(Time now) const {
  const bool fresh = Seconds(now - pose_->stamp) <= kFreshPoseS;
  return fresh && (!corrected_ || pose_->stamp >= *corrected_ + kStampRounding);
}

void DoorMission::EvaluatePose(Time now, MissionActions& actions) {
  const auto uncertainty = AtDoor(*door_, pose_->map_from_base, pose_->covariance, config_.drift);
  const double gap_m = GapLeft(*door_, footprint_, uncertainty) - config_.tracking_m;
  const std::string figures =
      fmt::format("2 sigma at the door {:.3f} m and {:.1f} degrees", 2 * uncertainty.lateral_sigma_m,
                  Degrees(2 * uncertainty.heading_sigma_rad));
  if (gap_m < 0) {
    if (looks_.Exhausted()) Fail("the pose is too uncertain for the gap: " + figures, actions);
    return;
  }
  const DoorPath path = planner_.PlanPassage(*door_, PredictedPose(now));
  if (!path.ok()) return Fail(path.refusal, actions);
  SendPath(path.points, config_.speed_m_s, now, actions);
  Enter(Phase::kPassing, "passing the door: " + figures);
}

void DoorMission::Pass(Time now, MissionActions& actions) {
  SettleLook(now, actions);
  if (WayToDoor() > config_.confirm_to_m && looks_.Ready(now) && !looks_.Exhausted()) AskLook(now, actions);
  const bool arrived = drive_ && drive_->path_id == path_.path_id && drive_->mode == DriveMode::kArrived;
  if (!arrived) return;
  if (-WayToDoor() >= planner_.PastX(*door_))
    return Enter(Phase::kDone, fmt::format("through the door after {:.1f} s", Seconds(now - started_)));
  // The pose may be older than the report of the arrival; once it is fresh it must be behind the door.
  if (pose_->stamp > path_sent_ && Seconds(now - pose_->stamp) < kFreshPoseS &&
      std::hypot(pose_->velocity.vx, pose_->velocity.vy) < 0.02)
    Fail(fmt::format("the path ended {:.2f} m before the door was passed",
                     planner_.PastX(*door_) + WayToDoor()),
         actions);
}

void DoorMission::SendPath(std::vector<Pose2> points, double speed_m_s, Time now, MissionActions& actions) {
  last_id_ = last_id_ % kIds + 1;
  path_ = {last_id_, speed_m_s, std::move(points)};
  path_sent_ = now;
  actions.path = path_;
}

void DoorMission::RepeatUnconfirmedPath(Time now, MissionActions& actions) {
  if (state_.phase == Phase::kWaiting || (drive_ && drive_->path_id == path_.path_id)) return;
  if (Seconds(now - path_sent_) < config_.resend_path_s) return;
  path_sent_ = now;
  actions.path = path_;
}

Pose2 DoorMission::PredictedPose(Time now) const {
  const double ahead_s = std::clamp(Seconds(now - pose_->stamp), 0.0, kFreshPoseS) + config_.command_delay_s;
  return Integrate(pose_->map_from_base, pose_->velocity, ahead_s);
}

double DoorMission::WayToDoor() const {
  return -(door_->map_from_door().Inverse() * pose_->map_from_base).x;
}

double DoorMission::ApproachSpeed(double way_m) const {
  return std::clamp((way_m - config_.look_to_m) / config_.looks_take_s, config_.slowest_m_s,
                    config_.speed_m_s);
}

}  // namespace priamos::planner
