#include "planner/core/missions/door_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/core/map/door_sides.hpp"
#include "planner/core/map/map_landmarks.hpp"
#include "planner/core/path/leaf_clearance.hpp"

namespace priamos::planner {
namespace {

/// The robot's stamps are rounded to 10 ms on the radio: a pose must be this much younger than a correction
/// to surely contain it.
constexpr Duration kStampRounding = std::chrono::milliseconds(30);
/// Share of the ordered speed from which on the base counts as driving.
constexpr double kAtSpeed = 0.8;
/// Waiting longer for the speed than this would cost more distance than it is worth.
constexpr double kStart_s = 3.0;

const std::string kTooUncertain = "the pose is too uncertain for the gap: ";

/// The sonars see the sides of an opening as near up to this distance from the base each.
constexpr double kBothNear_m = 0.30;
/// An opening that was passed so near to the door is the door.
constexpr double kAtDoor_m = 0.5;

/// Going back by less than this shows no more of a door.
constexpr double kWorthIt_m = 0.4;

/// A leaf is refused when it would be too narrow even if it stood open so many sigmas wider.
constexpr double kSure = 2;
/// Up to this far beyond the hold point the robot can still end before the door; then it goes on.
constexpr double kTurnBack_m = 0.5;

double Speed(const RobotPose& pose) {
  return std::hypot(pose.velocity.vx, pose.velocity.vy);
}

std::string Advised(const Stop& stop) {
  if (stop.cause == Stop::Cause::kUncertain) return stop.reason;
  return stop.reason + "; next: look what it is, and order it again";
}

/// Whether the newest pose is fresh and surely contains the newest correction.
bool PoseIsCorrected(const MissionControl& control) {
  const Heard& heard = control.heard();
  return IsFresh(*heard.pose, control.now()) &&
         (!heard.corrected || heard.pose->stamp >= *heard.corrected + kStampRounding);
}

}  // namespace

void DoorMissionConfig::Describe(Archive& a) {
  a.Number("speed_m_s", speed_m_s, {"m/s", 0.05, 1, "on the approach and through the door"});
  a.Number("slowest_m_s", slowest_m_s, {"m/s", 0.05, 1, "on a short approach"});
  if (slowest_m_s > speed_m_s) a.Refuse("slowest_m_s", "at most speed_m_s");
  a.Number("look_from_m", look_from_m,
           {"m", 1.5, 10, "distance to the door from which on the head may look"});
  a.Number("look_to_m", look_to_m, {"m", 1, 10, "distance to the door at which both looks should be done"});
  if (look_to_m > look_from_m) a.Refuse("look_to_m", "at most look_from_m");
  a.Number("looks_take_s", looks_take_s, {"s", 0.5, 60, "both looks, starting and radio included"});
  a.Number(
      "stand_back_m", stand_back_m,
      {"m", 0, 10, "distance to the door to which it goes back when looks from nearer failed; 0: never"});
  a.Number("one_side_m", one_side_m,
           {"m", 0, 10, "distance to the door up to which looks while passing stay on one side"});
  a.Number("confirm_to_m", confirm_to_m,
           {"m", 0, 10, "distance to the door down to which looks go on while passing"});
  a.Number("command_delay_s", command_delay_s, {"s", 0, 2, "from a decision here to the wheels there"});
  a.Number("evidence_s", evidence_s,
           {"s", 0, 60, "wait behind the door for the sonars' report of an opening"});
  a.Integer("retries", retries, {"-", 0, 10, "tries after an obstacle in the door"});
  limits.Describe(a);
  passage.Describe(a);
  a.Section("look", look, "looks at the sides of the door");
}

DoorMission::DoorMission(const DoorMissionConfig& config, const DoorPlannerConfig& planner,
                         const Footprint& footprint, const GroundPlan& plan)
    : config_(config),
      planner_(planner, footprint, plan),
      footprint_(footprint),
      plan_(plan),
      looks_(config.look),
      decision_(config.passage, footprint) {}

std::optional<Refusal> DoorMission::Start(const MissionOrder& order) {
  front_ = plan_.FindDoor(order.landmark_id);
  door_ = front_ ? std::optional(*front_) : std::nullopt;
  judge_ = false;
  at_hold_ = leaves_ = false;
  arrived_.reset();
  blocked_ = 0;
  stood_back_ = false;
  looks_.Reset();
  leaf_.Reset();
  if (!door_) return Refusal{fmt::format("the map has no door {}", order.landmark_id)};
  return std::nullopt;
}

std::optional<Refusal> DoorMission::ChooseSide(const Pose2& map_from_base) {
  door_ = *front_;
  const double behind_m = (front_->map_from_door().Inverse() * map_from_base).x;
  if (behind_m <= 0) return std::nullopt;
  const DoorPlan behind = priamos::planner::FromBehind(*front_);
  leaves_ = planner_.CabinPlace(behind).has_value();
  if (front_->behind_id == 0 && !leaves_)
    return Refusal{fmt::format(
        "the robot is {:.2f} m behind door '{}', and the map has no landmark there; next: give the "
        "door a behind_id",
        behind_m, front_->name)};
  door_ = behind;
  return std::nullopt;
}

void DoorMission::Step(MissionControl& control) {
  for (const LookResult& result : control.heard().looks) looks_.OnResult(result);
  if (JudgeLeaf(control)) return;
  switch (control.state().phase) {
    case Phase::kWaiting:
      return Wait(control);
    case Phase::kApproaching:
      return Approach(control);
    case Phase::kLookingLeft:
    case Phase::kLookingRight:
      return LookAtDoor(control);
    case Phase::kPassing:
      return Pass(control);
    case Phase::kRetreating:
      return Retreat(control);
    case Phase::kDriving:
    case Phase::kDone:
    case Phase::kFailed:
      break;
  }
}

bool DoorMission::JudgeLeaf(MissionControl& control) {
  for (const LeafSighting& leaf : control.heard().leaves)
    if (leaf.landmark_id == front_->id && leaf.stamp >= control.started()) leaf_.Add(leaf);
  const Phase phase = control.state().phase;
  const bool before =
      phase == Phase::kLookingLeft || phase == Phase::kLookingRight ||
      (phase == Phase::kPassing && -DistanceToDoor(control) < planner_.HoldX(*door_) + kTurnBack_m);
  if (!before) return false;
  const auto reason = LeafInTheWay();
  if (reason) control.Fail(*reason);
  return reason.has_value();
}

std::optional<std::string> DoorMission::LeafInTheWay() const {
  if (FromBehind()) return std::nullopt;
  const auto leaf = leaf_.Estimate();
  if (!leaf) return std::nullopt;
  const double widest_m = FreeWidth(*door_, leaf->hinge, leaf->open_rad + kSure * leaf->sigma_rad);
  if (widest_m >= planner_.NeededWidth()) return std::nullopt;
  return fmt::format("door '{}' stands open only {:.0f} degrees: {:.2f} m are free, {:.2f} m needed",
                     door_->name, Degrees(leaf->open_rad), FreeWidth(*door_, leaf->hinge, leaf->open_rad),
                     planner_.NeededWidth());
}

void DoorMission::Wait(MissionControl& control) {
  const Heard& heard = control.heard();
  if (!heard.link_up || !heard.pose || !IsFresh(*heard.pose, control.now())) return;
  if (const auto refusal = ChooseSide(heard.pose->map_from_base)) return control.Fail(refusal->reason);
  if (const auto refusal = planner_.CheckDoor(*door_)) return control.Fail(refusal->reason);
  if (leaves_) return Leave(control);
  const auto path = planner_.PlanApproach(*door_, heard.pose->map_from_base);
  if (!path) return control.Fail(path.reason());
  control.SendModel(*MakeLandmark(plan_, door_->id));
  const double distance_m = DistanceToDoor(control);
  const double speed_m_s = ApproachSpeed(distance_m);
  control.OrderPath(*path, speed_m_s);
  entered_ = control.now();
  control.Enter(Phase::kApproaching, fmt::format("approaching door '{}', {:.1f} m away, at {:.2f} m/s",
                                                 door_->name, distance_m, speed_m_s));
}

/// By dead reckoning since the looks at the door from outside, as far as that is sure enough.
void DoorMission::Leave(MissionControl& control) {
  if (came_by_ != front_->id)
    return control.Fail(
        fmt::format("it did not come in through door '{}', which cannot be looked at from so "
                    "near; next: drive it out by hand",
                    front_->name));
  const RobotPose& pose = *control.heard().pose;
  const double distance_m = DistanceToDoor(control);
  const auto prospect = decision_.Expect(*door_, pose.covariance, distance_m, distance_m);
  if (!prospect.Fits()) return control.Fail(kTooUncertain + prospect.Text());
  const auto path = planner_.PlanLeave(*door_, pose.map_from_base);
  if (!path) return control.Fail(path.reason());
  control.OrderPath(*path, config_.slowest_m_s);
  control.Enter(Phase::kPassing, "leaving the cabin: " + prospect.Text());
}

void DoorMission::Approach(MissionControl& control) {
  if (DistanceToDoor(control) > config_.look_from_m) return;
  // A robot that stands sees just as well, but the point of one stereo pair is not to stand: let it get
  // going.
  const bool waited = Seconds(control.now() - entered_) > kStart_s;
  if (Speed(*control.heard().pose) < kAtSpeed * control.path().speed_m_s && !waited) return;
  LookFromHere(control);
}

void DoorMission::AskLook(MissionControl& control) {
  looks_.Asked(control.OrderLook(door_->id, looks_.next()), control.now());
}

void DoorMission::LookFromHere(MissionControl& control) {
  const Side side = looks_.next();
  AskLook(control);
  control.Enter(side == Side::kLeft ? Phase::kLookingLeft : Phase::kLookingRight,
                fmt::format("looking at the {} side of the door, {:.1f} m away", NameOf(side),
                            DistanceToDoor(control)));
}

bool DoorMission::SettleLook(MissionControl& control) {
  const auto result = looks_.Settle(control.now());
  if (!result) return false;
  if (!result->ok && result->no_model) control.SendModel(*MakeLandmark(plan_, door_->id));
  return result->ok;
}

/// Looks that failed on the way say little about those from the hold point.
void DoorMission::NoteArrivalAtHold(const MissionControl& control) {
  const bool arrived = control.OnPath() && control.heard().drive->mode == DriveMode::kArrived;
  if (arrived && !at_hold_) looks_.ForgetFailures();
  at_hold_ = arrived;
}

void DoorMission::LookAtDoor(MissionControl& control) {
  NoteArrivalAtHold(control);
  const int failures = looks_.failures();
  if (SettleLook(control)) judge_ = looks_.Enough();
  if (looks_.failures() > failures) control.Enter(control.state().phase, looks_.trouble());
  if (judge_ && PoseIsCorrected(control)) {
    judge_ = false;
    EvaluatePose(control);
  }
  const Phase phase = control.state().phase;
  const bool looking = phase == Phase::kLookingLeft || phase == Phase::kLookingRight;
  if (!looking || !looks_.Ready(control.now())) return;
  if (!LooksUsedUp()) return LookFromHere(control);
  if (!judge_ && !StandBack(control))
    control.Fail(
        fmt::format("{} looks failed, the last one: {}; next: look whether the door is shut or hidden, "
                    "and order it again",
                    looks_.failures(), looks_.trouble()));
}

bool DoorMission::StandBack(MissionControl& control) {
  if (stood_back_ || DistanceToDoor(control) > config_.stand_back_m - kWorthIt_m) return false;
  stood_back_ = true;
  const Pose2& from = control.heard().pose->map_from_base;
  const auto path = planner_.PlanStandBack(*door_, from, config_.stand_back_m);
  if (!path) return false;
  stopped_by_ = {Stop::Cause::kUncertain,
                 fmt::format("{} looks failed, the last one: {}", looks_.failures(), looks_.trouble())};
  give_up_ = at_hold_ = false;
  control.OrderPath(*path, config_.slowest_m_s);
  control.Enter(Phase::kRetreating, fmt::format("{}: back to {:.1f} m before the door, to see more of it",
                                                stopped_by_.reason, config_.stand_back_m));
  return true;
}

void DoorMission::EvaluatePose(MissionControl& control) {
  const auto prospect = decision_.Expect(*door_, control.heard().pose->covariance, DistanceToDoor(control));
  if (!prospect.Fits()) {
    if (LooksUsedUp()) control.Fail(kTooUncertain + prospect.Text());
    return;
  }
  if (!SetOut(control, config_.speed_m_s)) return;
  control.Enter(Phase::kPassing, "passing the door: " + prospect.Text());
  decision_.Begin();
}

bool DoorMission::SetOut(MissionControl& control, double speed_m_s) {
  const auto path = planner_.PlanPassage(*door_, PredictedPose(control));
  path ? control.OrderPath(*path, speed_m_s) : control.Fail(path.reason());
  return static_cast<bool>(path);
}

/// Looks go on until the last place from which it can go back.
void DoorMission::Confirm(MissionControl& control, double distance_m) {
  if (distance_m > config_.confirm_to_m && looks_.Ready(control.now()) && !looks_.FailedTooOften()) {
    if (distance_m < config_.one_side_m) looks_.StayOnSide(distance_m < config_.passage.commit_m);
    AskLook(control);
  }
  Commit(control, distance_m);
}

/// The looks on the way may have been worse than expected; the last place from which it can go back.
void DoorMission::Commit(MissionControl& control, double distance_m) {
  const Eigen::Matrix3d& covariance = control.heard().pose->covariance;
  const PassageStep step = decision_.Next(*door_, covariance, distance_m);
  if (step == PassageStep::kSlowDown) SetOut(control, config_.slowest_m_s);
  if (step == PassageStep::kGoBack)
    OnStop(control, {Stop::Cause::kUncertain,
                     kTooUncertain + decision_.Expect(*door_, covariance, distance_m, distance_m).Text()});
}

void DoorMission::Pass(MissionControl& control) {
  SettleLook(control);
  const double distance_m = DistanceToDoor(control);
  if (!leaves_) Confirm(control, distance_m);
  if (!control.OnPath() || control.heard().drive->mode != DriveMode::kArrived) return;
  if (-distance_m >= planner_.PastX(*door_)) return Arrive(control);
  // The pose may be older than the report of the arrival; once it is fresh it must be behind the door.
  const RobotPose& pose = *control.heard().pose;
  if (pose.stamp > control.path_sent() && Seconds(control.now() - pose.stamp) < kFreshPose_s &&
      Speed(pose) < 0.02)
    control.Fail(fmt::format("the path ended {:.2f} m before the door was passed",
                             planner_.PastX(*door_) + distance_m));
}

/// A robot that stands in the door goes back first, so that the doorway is free.
void DoorMission::OnStop(MissionControl& control, const Stop& stop) {
  const Phase phase = control.state().phase;
  const bool doorway_is_free = DistanceToDoor(control) > footprint_.length_m / 2 - door_->FrontX();
  if (phase == Phase::kRetreating && stop.cause == Stop::Cause::kBlocked && doorway_is_free)
    return TryAgain(control);
  if (phase == Phase::kRetreating)
    return control.Fail(fmt::format("{}, and on its way back {}", stopped_by_.reason, Advised(stop)));
  if (phase != Phase::kPassing) return control.Fail(Advised(stop));
  stopped_by_ = stop;
  give_up_ = stop.cause == Stop::Cause::kTouched || ++blocked_ > config_.retries;
  if (-DistanceToDoor(control) <= planner_.HoldX(*door_)) return TryAgain(control);
  const auto path = planner_.PlanRetreat(*door_, control.heard().pose->map_from_base);
  if (!path) return control.Fail(Advised(stop));
  control.OrderPath(*path, config_.slowest_m_s);
  control.Enter(Phase::kRetreating, stop.reason + ": back to the place before the door");
}

void DoorMission::Retreat(MissionControl& control) {
  SettleLook(control);
  if (control.OnPath() && control.heard().drive->mode == DriveMode::kArrived) TryAgain(control);
}

/// What stood in the door may have gone.
void DoorMission::TryAgain(MissionControl& control) {
  if (give_up_) return control.Fail(Advised(stopped_by_));
  if (leaves_) return Leave(control);
  looks_.Reset();
  leaf_.Reset();
  judge_ = false;
  LookFromHere(control);
}

/// Behind the door by its pose; done when the sonars noticed the door as well, for which the message may be
/// on its way.
void DoorMission::Arrive(MissionControl& control) {
  if (!arrived_) arrived_ = control.now();
  if (DoorWasNoticed(control)) {
    came_by_ = front_->id;
    return control.Enter(Phase::kDone, fmt::format("through the door after {:.1f} s",
                                                   Seconds(control.now() - control.started())));
  }
  if (Seconds(control.now() - *arrived_) > config_.evidence_s)
    control.Fail("the robot believes to be behind the door, but its sonars noticed no opening there");
}

/// A door so wide that the sonars do not see both sides as near is passed by pose alone.
bool DoorMission::DoorWasNoticed(const MissionControl& control) const {
  if (door_->opening_width_m > footprint_.width_m + 2 * kBothNear_m) return true;
  const auto& opening = control.heard().opening;
  if (!opening || opening->stamp < control.started()) return false;
  const Pose2 there = door_->map_from_door().Inverse() * opening->map_from_base;
  return there.translation().norm() < kAtDoor_m;
}

Pose2 DoorMission::PredictedPose(const MissionControl& control) const {
  const RobotPose& pose = *control.heard().pose;
  const double ahead_s =
      std::clamp(Seconds(control.now() - pose.stamp), 0.0, kFreshPose_s) + config_.command_delay_s;
  return Integrate(pose.map_from_base, pose.velocity, ahead_s);
}

double DoorMission::DistanceToDoor(const MissionControl& control) const {
  return -(door_->map_from_door().Inverse() * control.heard().pose->map_from_base).x;
}

double DoorMission::ApproachSpeed(double distance_m) const {
  return std::clamp((distance_m - config_.look_to_m) / config_.looks_take_s, config_.slowest_m_s,
                    config_.speed_m_s);
}

}  // namespace priamos::planner
