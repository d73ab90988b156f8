#include "robot/core/motion/drive_controller.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;

// Two and a half periods: a late message is not yet silence.
constexpr milliseconds kWheelsDue{50};
constexpr milliseconds kSonarDue{250};
constexpr milliseconds kBumperDue{100};
constexpr milliseconds kHeadDue{1500};
constexpr double kStanding = 0.01;     ///< [m/s] slower is standing
constexpr double kWantsToMove = 0.03;  ///< [m/s]
constexpr double kCreeping = 0.05;     ///< [m/s] before an obstacle this is standing, too
constexpr double kSlowed = 0.98;       ///< a scale below this is reported as a limit

double SpeedOf(const Twist2& twist) {
  return std::hypot(twist.vx, twist.vy) + std::abs(twist.wz) * PathShape::kTurnLever;
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

/// What ends a motion because something holds the base.
bool IsContact(const std::optional<Condition>& cause) {
  return cause == Condition::kTouched || cause == Condition::kWheelsStuck;
}

CollisionStopConfig WithMargin(CollisionStopConfig config, double more_m) {
  config.margin_m += more_m;
  config.memory_margin_m += more_m;
  return config;
}

/// What stops the base for `blocked_s` is not to be told twice within that time.
ProgressWatch::Limits ProgressLimits(const DriveConfig& config) {
  return {FromSeconds(std::max(config.waits_s, config.blocked_s)),
          FromSeconds(std::max(config.no_nearer_s, config.blocked_s))};
}

}  // namespace

DriveController::DriveController(const DriveConfig& config, const MecanumGeometry& geometry)
    : config_(config),
      geometry_(geometry),
      follower_(config.follower, config.footprint),
      corridor_(config.corridor, config.yield, config.footprint),
      slew_(config.acceleration),
      operator_slew_(config.operator_acceleration),
      brake_(config.braking),
      surroundings_(config),
      meeting_(config.meeting),
      progress_(ProgressLimits(config)),
      collision_(config.collision, config.footprint),
      rough_collision_(WithMargin(config.collision, config.operator_margin_m), config.footprint),
      touch_(config.touch, config.footprint, geometry),
      authority_(config.authority),
      failsafe_(config.failsafe) {}

void DriveController::Reconfigure(const DriveConfig& config) {
  config_.operator_margin_m = config.operator_margin_m;
  config_.lost_position_m = config.lost_position_m;
  config_.lost_yaw_deg = config.lost_yaw_deg;
  config_.blocked_s = config.blocked_s;
  progress_ = ProgressWatch(ProgressLimits(config_));
  follower_.LimitSpeeds(config.follower.shape);
  operator_slew_.set_limits(config.operator_acceleration);
  surroundings_.Believe(config.echoes);
  collision_ = CollisionStop(config.collision, config_.footprint);
  rough_collision_ = CollisionStop(WithMargin(config.collision, config.operator_margin_m), config_.footprint);
}

PathVerdict DriveController::SetPath(const Path& path, Time now) {
  const bool driving_it = path_is_new_ || follower_.has_path();
  if (driving_it && path_ && SameCourse(*path_, path)) return PathVerdict::kSame;
  if (!authority_.AdmitPath(now))
    return authority_.estop() ? PathVerdict::kEstop : PathVerdict::kWithoutLease;
  if (!path.points.empty() && path.estop_changes != authority_.estop_changes()) return PathVerdict::kStale;
  if (!path.points.empty() && authority_.Stands(now)) return PathVerdict::kTouched;
  path_ = path;
  path_is_new_ = !path.points.empty();
  ever_ordered_ = true;
  state_.path_id = path.id;
  // An order to stand moves nothing: what the base touched is still to be told.
  if (!path.points.empty() || !IsContact(state_.halted_by)) state_.halted_by.reset();
  if (path.points.empty()) follower_.Drop();
  // Also while something keeps the base from beginning: what it says is of this path from now on.
  state_.mode = path.points.empty() ? DriveMode::kHolding : DriveMode::kFollowing;
  return PathVerdict::kTaken;
}

bool DriveController::ForgetDrivenPath() {
  if (HasPathToGo()) return false;
  DropPath();
  return true;
}

CommandVerdict DriveController::SetCommand(const DriveCommand& command, Time now) {
  const CommandVerdict verdict = authority_.Admit(command, now);
  if (verdict != CommandVerdict::kAccepted || authority_.estop()) return verdict;
  ever_ordered_ = true;
  DropPath();
  state_.mode = DriveMode::kOperated;
  if (WantsMotion(command.twist) || !IsContact(state_.halted_by)) state_.halted_by.reset();
  return verdict;
}

Lease::Answer DriveController::RequestLease(const LeaseHolder& who, Lease::Wish wish, Time now) {
  return authority_.Request(who, wish, now);
}

std::optional<WheelSpeeds> DriveController::Step(const DriveSituation& situation, Time now) {
  if (!first_step_) first_step_ = now;
  const double dt_s = last_step_ ? std::clamp(Seconds(now - *last_step_), 1e-3, 0.1) : 0.02;
  last_step_ = now;
  if (surroundings_.heard()) sonar_heard_ = surroundings_.heard();
  surroundings_.Forget(situation.odom_from_base, now, HasPathToGo());
  authority_.Tick(now, HasPathToGo());
  if (authority_.holder().driver != Driver::kPlanner && !authority_.lease_lost()) DropPath();
  NoteTouch(situation, now);
  if (path_is_new_ && situation.estimate) state_.remaining_m = LengthFrom(situation.estimate->pose, *path_);
  const DriveSource source = Source(now);
  state_.failsafe = Watch(situation, now);
  stands_for_comer_ = false;
  if (state_.failsafe.action == FailsafeAction::kHalt) Halt(*state_.failsafe.cause, situation, now);

  const Obstacles around = Around(situation.odom_from_base);
  const Twist2 wanted = Wanted(situation, around, now, dt_s), free = FreeOf(wanted, around);
  // Once more: between two free motions the slewed motion may pass through one that is not.
  const Twist2 next = FreeOf(Slewed(free, dt_s), around);
  const CollisionStop::Result result = Guard().Limit(next, around.seen, around.remembered);
  const WheelSpeeds wheels = Saturated(geometry_, ToWheelSpeeds(geometry_, result.twist));
  SetCommanded(FromWheelSpeeds(geometry_, wheels).twist);
  NoteSonar(wanted, free, around, result);
  NoteBlocked(wanted, result.twist, now);
  NoteWaiting(situation, around, now);
  NoteStuck(situation, now);
  NoteEnd(source);
  if (!ever_ordered_) return std::nullopt;
  return wheels;
}

Obstacles DriveController::Around(const Pose2& odom_from_base) const {
  Obstacles around = surroundings_.Around(odom_from_base, IsRough(), HeedsMovers());
  const std::vector<Eigen::Vector2d> touched = touch_.Points(odom_from_base);
  around.seen.insert(around.seen.end(), touched.begin(), touched.end());
  return around;
}

const CollisionStop& DriveController::Guard() const {
  return IsRough() ? rough_collision_ : collision_;
}

/// Whether nobody has planned this motion to the centimetre though things may be near, and the walls that are
/// heard do not lead it.
bool DriveController::IsRough() const {
  return state_.mode == DriveMode::kOperated || (follower_.LeewayHere().little() && !InCorridor());
}

bool DriveController::HasPathToGo() const {
  return path_is_new_ || (follower_.has_path() && state_.mode != DriveMode::kArrived);
}

void DriveController::DropPath() {
  follower_.Drop();
  path_is_new_ = false;
}

DriveSource DriveController::Source(Time now) const {
  if (follower_.has_path() || path_is_new_) return DriveSource::kPath;
  if (authority_.Wish(now) || authority_.OperatorFellSilent(now)) return DriveSource::kOperator;
  return DriveSource::kNone;
}

FailsafeDecision DriveController::Watch(const DriveSituation& situation, Time now) {
  if (!IsLost(situation)) pose_lost_since_.reset();
  if (IsLost(situation) && !pose_lost_since_) pose_lost_since_ = now;
  const auto when = [](bool present) { return present ? Duration::max() : Duration::zero(); };
  const bool needs_fix = situation.estimate && situation.estimate->PositionSigma() > config_.fix_needed_m;

  FailsafeInputs inputs;
  inputs.source = Source(now);
  inputs[Condition::kEstop] = when(authority_.estop());
  inputs[Condition::kTouched] = when(state_.touch && state_.touch->time == now && !state_.touch->came);
  inputs[Condition::kBumped] = Lasting(bumped_since_, now);
  inputs[Condition::kLeaseLost] = when(authority_.lease_lost());
  inputs[Condition::kOperatorSilent] = when(authority_.OperatorFellSilent(now));
  inputs[Condition::kWheelsSilent] = Silence(situation.wheels_heard, *first_step_, now, kWheelsDue);
  inputs[Condition::kWheelsStuck] = Lasting(stuck_since_, now);
  inputs[Condition::kSonarSilent] = Silence(sonar_heard_, *first_step_, now, kSonarDue);
  inputs[Condition::kPoseLost] = Lasting(pose_lost_since_, now);
  if (needs_fix) inputs[Condition::kHeadSilent] = Silence(situation.head_heard, *first_step_, now, kHeadDue);
  if (config_.touch.bumper)
    inputs[Condition::kBumperSilent] = Silence(touch_.bumper_heard(), *first_step_, now, kBumperDue);
  inputs[Condition::kLinkLost] = situation.link_down;
  state_.holder = authority_.holder();
  state_.estop = authority_.estop();
  state_.estop_changes = authority_.estop_changes();
  state_.refused_commands = authority_.input().refused();
  state_.refusal = authority_.input().newest_refusal();
  return failsafe_.Update(inputs, now);
}

/// Between walls that it hears a base is not lost, however little it knows of the map.
bool DriveController::IsLost(const DriveSituation& situation) const {
  if (situation.estimate && path_ && path_->centre) return false;
  return !situation.estimate || !(situation.estimate->PositionSigma() < config_.lost_position_m) ||
         !(situation.estimate->YawSigma() < Radians(config_.lost_yaw_deg));
}

Twist2 DriveController::Wanted(const DriveSituation& situation, const Obstacles& around, Time now,
                               double dt_s) {
  const bool by_path = follower_.has_path() || path_is_new_;
  if (!by_path) StandIfLetGo(now);
  if (state_.failsafe.action != FailsafeAction::kNone) return {};
  if (by_path) return WantedByPath(situation, around, now, dt_s);
  return WantedByOperator(now);
}

Twist2 DriveController::WantedByPath(const DriveSituation& situation, const Obstacles& around, Time now,
                                     double dt_s) {
  if (!situation.estimate) return {};
  const PoseEstimate& estimate = *situation.estimate;
  if (path_is_new_) {
    // What lasts too short to stop a drive is enough not to begin one.
    if (IsLost(situation)) return {};
    BeginPath(situation);
    progress_.Reset();
    path_is_new_ = false;
  }
  if (!follower_.has_path()) return {};
  if (path_->centre) KeepCentred(situation, now);
  if (follower_.LooksAround(now)) follower_.Avoid(ThingsInMap(situation, around, now), now);
  const double age_s = std::clamp(Seconds(now - estimate.time), 0.0, config_.failsafe.wheels_silent_s);
  const PathFollower::Wanted wanted = follower_.Step(estimate.pose, estimate.twist, age_s, dt_s);
  state_.remaining_m = wanted.remaining_m;
  state_.cross_track_m = wanted.cross_track_m;
  if (wanted.arrived) state_.mode = DriveMode::kArrived;
  if (HeedsMovers() && StandsForMover(situation, now)) return {};
  if (!InCorridor() || wanted.arrived) return wanted.twist;
  return corridor_.MakeRoom(surroundings_.movers(), wanted, situation.odom_from_base, now)
      .value_or(wanted.twist);
}

bool DriveController::StandsForMover(const DriveSituation& situation, Time now) {
  const Twist2& driven = situation.estimate->twist;
  const Eigen::Vector2d velocity(driven.vx, driven.vy);
  const bool about_to_meet =
      surroundings_.IsAboutToMeet(situation.odom_from_base, velocity, meeting_.within_s());
  stands_for_comer_ = meeting_.Stands(about_to_meet, now);
  if (stands_for_comer_) follower_.Waits();
  return stands_for_comer_;
}

/// An operator goes to and fro beside things, and in a doorway jambs come near: one of them might be taken
/// for somebody who comes.
bool DriveController::HeedsMovers() const {
  return InCorridor() || (state_.mode != DriveMode::kOperated && follower_.LeewayHere().any());
}

bool DriveController::InCorridor() const {
  return state_.mode != DriveMode::kOperated && path_ && path_->centre;
}

/// A centred path begins where the base is, in the direction of the corridor.
void DriveController::BeginPath(const DriveSituation& situation) {
  Pose2 start = situation.estimate->pose;
  if (path_->centre) {
    start.yaw = path_->points.front().yaw;
    corridor_.Begin(situation.odom_from_base,
                    WrapAngle(start.yaw - situation.estimate->pose.yaw + situation.odom_from_base.yaw));
  }
  follower_.Follow(*path_, start);
}

void DriveController::KeepCentred(const DriveSituation& situation, Time now) {
  if (state_.mode == DriveMode::kArrived || !corridor_.IsDue(now)) return;
  const Pose2& pose = situation.estimate->pose;
  const CentredPath centred =
      corridor_.Centred(*path_, pose, situation.odom_from_base, follower_.RemainingFrom(pose), now);
  follower_.Realign(centred.path, centred.start);
}

std::vector<Eigen::Vector2d> DriveController::ThingsInMap(const DriveSituation& situation,
                                                          const Obstacles& around, Time now) const {
  std::vector<Eigen::Vector2d> things = surroundings_.ToLeadAround(around, situation.odom_from_base, now);
  for (Eigen::Vector2d& thing : things) thing = situation.estimate->pose * thing;
  return things;
}

/// A stick that was let go stops the wheels now, also those that a hold is braking; the drive board's own
/// ramp is all the softness there is.
void DriveController::StandIfLetGo(Time now) {
  const Twist2* wish = authority_.Wish(now);
  if (wish && !WantsMotion(*wish)) SetCommanded({});
}

Twist2 DriveController::WantedByOperator(Time now) const {
  const Twist2* wish = authority_.Wish(now);
  return wish && WantsMotion(*wish) ? *wish : Twist2{};
}

/// What of a motion leads nowhere into an obstacle, where an operator drives: a path is driven or not.
Twist2 DriveController::FreeOf(const Twist2& motion, const Obstacles& around) const {
  if (state_.mode != DriveMode::kOperated) return motion;
  return Deflected(motion, config_.footprint.Reach(),
                   [&](const Twist2& part) { return Guard().Scale(part, around.seen, around.remembered); });
}

Twist2 DriveController::Slewed(const Twist2& wanted, double dt_s) {
  if (state_.failsafe.action != FailsafeAction::kNone || stands_for_comer_) return brake_.Step(wanted, dt_s);
  if (state_.mode == DriveMode::kOperated) return operator_slew_.Step(wanted, dt_s);
  return follower_.has_path() ? slew_.Step(wanted, dt_s) : brake_.Step(wanted, dt_s);
}

void DriveController::SetCommanded(const Twist2& twist) {
  slew_.SetCommanded(twist);
  operator_slew_.SetCommanded(twist);
  brake_.SetCommanded(twist);
}

/// Notes the share that deflection leaves of an operator's wish, or the collision stop of a path's velocity.
void DriveController::NoteSonar(const Twist2& wanted, const Twist2& free, const Obstacles& around,
                                const CollisionStop::Result& result) {
  const bool operated = state_.mode == DriveMode::kOperated;
  const double speed = collision_.SpeedOf(wanted);
  const double most = operated ? collision_.SpeedOf(free) : result.allowed.value_or(speed);
  const double left = speed > 0 ? std::min(1.0, most / speed) : 1.0;
  state_.nearest = operated ? Guard().Limit(wanted, around.seen, around.remembered).nearest : result.nearest;
  state_.slowed_by_sonar = left < kSlowed || stands_for_comer_;
  state_.allowed = state_.failsafe.action == FailsafeAction::kNone && !stands_for_comer_ ? left : 0;
}

void DriveController::NoteBlocked(const Twist2& wanted, const Twist2& given, Time now) {
  if (state_.mode != DriveMode::kFollowing && state_.mode != DriveMode::kBlocked) return;
  const bool stopped = state_.slowed_by_sonar && SpeedOf(wanted) > kWantsToMove && SpeedOf(given) < kCreeping;
  if (!stopped) blocked_since_.reset();
  if (stopped && !blocked_since_) blocked_since_ = now;
  const bool blocked = blocked_since_ && now - *blocked_since_ >= FromSeconds(config_.blocked_s);
  state_.mode = blocked ? DriveMode::kBlocked : DriveMode::kFollowing;
}

/// A base that gets nowhere because its follower finds no way around what is there, or because somebody is
/// about to walk into it again and again, wants no motion that the collision stop could limit. What is near
/// is to be told where the path goes on: the base may be going back just now.
void DriveController::NoteWaiting(const DriveSituation& situation, const Obstacles& around, Time now) {
  const bool on_its_way = state_.mode == DriveMode::kFollowing || state_.mode == DriveMode::kBlocked;
  const bool holds = state_.failsafe.action != FailsafeAction::kNone;
  if (!on_its_way || !follower_.has_path() || holds || follower_.BacksOff()) return progress_.Reset();
  if (!progress_.GetsNowhere(situation.odom_from_base, follower_.LengthLeft(), now)) return;
  state_.mode = DriveMode::kBlocked;
  state_.slowed_by_sonar = true;
  state_.allowed = 0;
  const auto ahead =
      Guard().Limit(follower_.Onward(situation.estimate->pose), around.seen, around.remembered).nearest;
  if (ahead) state_.nearest = ahead;
}

/// A base that stands, on its way or without one, or goes the other way, has touched nothing: somebody came
/// to it, and it goes on when he has left.
void DriveController::NoteTouch(const DriveSituation& situation, Time now) {
  std::optional<Twist2> motion;
  if (Source(now) != DriveSource::kOperator && situation.estimate) motion = situation.estimate->twist;
  if (motion && stands_for_comer_) motion = Twist2{};  // it brakes for who came, and he was faster
  const auto touch = touch_.Update(situation.odom_from_base, now, motion);
  if (touch) state_.touch = touch;
  const bool stands = motion && SpeedOf(*motion) < kStanding;
  const bool may_touch = stands && (!HasPathToGo() || HeedsMovers()) && surroundings_.approach().MayTouch();
  if (!touch_.pressed() && !may_touch) bumped_since_.reset();
  if ((touch && touch->came) || (may_touch && !bumped_since_)) bumped_since_ = now;
  if (bumped_since_) bumped_ = now;
  state_.bumped = bumped_ && now - *bumped_ < FromSeconds(config_.failsafe.bumped_s);
}

void DriveController::NoteStuck(const DriveSituation& situation, Time now) {
  const bool ordered_to_move = SpeedOf(slew_.commanded()) > kCreeping;
  const bool stands = situation.estimate && SpeedOf(situation.estimate->twist) < kStanding;
  if (!ordered_to_move || !stands) stuck_since_.reset();
  if (ordered_to_move && stands && !stuck_since_) stuck_since_ = now;
}

/// An operator who rested the stick and then fell silent has simply finished.
void DriveController::NoteEnd(DriveSource source) {
  if (state_.mode == DriveMode::kOperated && source == DriveSource::kNone) state_.mode = DriveMode::kHolding;
}

/// Orders that are on their way were given without knowing of it, and would hide it.
void DriveController::StandAfterContact(Time now) {
  authority_.StandUntil(now + FromSeconds(config_.touch.told_s));
}

/// A base that still rolls although nobody drives it any more touches things, too.
void DriveController::Halt(Condition cause, const DriveSituation& situation, Time now) {
  const bool driven = Source(now) != DriveSource::kNone || authority_.lease_lost();
  const bool rolls = situation.estimate && SpeedOf(situation.estimate->twist) > kStanding;
  const bool moved = driven || (cause == Condition::kTouched && rolls);
  if (moved) state_.halted_by = cause;
  if (moved && IsContact(cause)) StandAfterContact(now);
  DropPath();
  authority_.Forget();
  SetCommanded({});
  if (state_.mode != DriveMode::kIdle) state_.mode = DriveMode::kHolding;
}

}  // namespace priamos::robot
