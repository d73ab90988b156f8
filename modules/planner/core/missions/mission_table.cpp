#include "planner/core/missions/mission_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace priamos::planner {
namespace {

/// A report of a touch, after the one before it: somebody who comes to a robot that has arrived, or stood
/// already without a way to go, has ended no motion. What it touches itself on the way has it hold.
DriveReport WithoutBump(DriveReport drive, const std::optional<DriveReport>& before) {
  const bool held = before && before->path_id == drive.path_id && !before->touched &&
                    before->mode == DriveMode::kHolding && drive.mode == DriveMode::kHolding;
  if (!drive.touched || !(held || drive.mode == DriveMode::kArrived)) return drive;
  drive.touched = false;
  drive.limit = "somebody touched the standing robot";
  return drive;
}

std::string Because(const DriveReport& drive) {
  return drive.limit.empty() ? "" : ": " + drive.limit;
}

}  // namespace

void MissionLimits::Describe(Archive& a) {
  a.Number("resend_path_s", resend_path_s, {"s", 1, 60, "a path not confirmed by then is sent again"});
  a.Number("blocked_s", blocked_s, {"s", 1, 600, "standing before an obstacle that stops the mission"});
  a.Number("silent_s", silent_s, {"s", 1, 600, "silence of the robot that ends the mission"});
  a.Number("limit_s", limit_s, {"s", 5, 3600, "time for the whole mission"});
}

void MissionTable::Add(int kind, std::unique_ptr<Mission> mission) {
  if (missions_.empty()) kind_ = kind;
  if (!missions_.emplace(kind, std::move(mission)).second)
    throw std::logic_error(fmt::format("two missions of kind {}", kind));
}

bool MissionTable::Start(Time now, const MissionOrder& order) {
  if (running()) return false;
  kind_ = order.kind;
  aborted_.reset();
  blocked_since_.reset();
  paused_since_.reset();
  touched_ = false;
  touched_path_.reset();
  idle_ = {};
  last_tick_ = now;
  control_.Begin(now);
  if (auto refusal = missions_.at(kind_)->Start(order))
    control_.Enter(Phase::kFailed, std::move(refusal->reason));
  return true;
}

void MissionTable::Abort(std::string reason) {
  if (running()) aborted_ = std::move(reason);
}

void MissionTable::Stand(Time now) {
  if (!running()) control_.Stand(now);
}

void MissionTable::Pause(Time now) {
  if (!running()) return Stand(now);
  control_.now_ = now;
  if (paused_since_) return control_.SendPath();
  paused_since_ = now;
  blocked_since_.reset();
  control_.Hold();
}

void MissionTable::Resume(Time now) {
  if (!paused_since_) return;
  control_.now_ = now;
  paused_since_.reset();
  if (running()) control_.GoOn();
}

void MissionTable::OnPose(const RobotPose& pose) {
  auto& newest = control_.heard_.pose;
  if (!newest || pose.stamp > newest->stamp) newest = pose;
}

void MissionTable::OnDrive(const DriveReport& told, Time now) {
  const DriveReport drive = WithoutBump(told, control_.heard().drive);
  control_.NoteDrive(drive);
  NoteTouch(drive);
  // Who was ordered to stand is not stopped by anything.
  const bool stands = (drive.mode == DriveMode::kBlocked || drive.mode == DriveMode::kHolding) &&
                      !control_.path().points.empty();
  if (!stands || !running() || paused_since_ || !control_.OnPath()) {
    blocked_since_.reset();
  } else if (!blocked_since_) {
    blocked_since_ = now;
  }
}

/// A touch ends the motion on which it was. When the next path was on its way by then, it is reported of a
/// path that is not the newest; each counts once.
void MissionTable::NoteTouch(const DriveReport& drive) {
  if (!drive.touched || !running() || !control_.IsOwn(drive.path_id)) return;
  touched_ = touched_ || touched_path_ != drive.path_id;
  touched_path_ = drive.path_id;
}

void MissionTable::OnCorrected(Time stamp) {
  auto& newest = control_.heard_.corrected;
  newest = std::max(stamp, newest.value_or(stamp));
}

MissionActions MissionTable::Tick(Time now) {
  control_.now_ = now;
  const bool idle = running() && (paused_since_ || Silence_s(now));
  if (idle) idle_ += now - last_tick_;
  last_tick_ = now;
  if (running())
    Step(*missions_.at(kind_));
  else if (missions_.contains(kind_))
    control_.RepeatUnconfirmedStand(now, ResendAfter_s());
  // What arrives while the mission is idle is for its next step.
  control_.RepeatPlace();
  if (!idle || !running()) {
    control_.heard_.looks.clear();
    control_.heard_.told.clear();
    control_.heard_.leaves.clear();
  }
  return std::exchange(control_.actions_, {});
}

void MissionTable::Step(Mission& mission) {
  if (const auto reason = ReasonToEnd(mission)) {
    control_.Fail(*reason);
    return mission.OnEnded(control_);
  }
  if (Silence_s(control_.now())) return;
  if (!paused_since_) Decide(mission);
  if (running()) control_.RepeatUnconfirmedPath(ResendAfter_s());
  if (running()) control_.RepeatFaces();
}

/// An order to stand that a person gave is not waited for as long as a path: meanwhile the robot drives.
double MissionTable::ResendAfter_s() const {
  constexpr double kStandAgain_s = 2;  // PATH has 0.5 Hz on the radio
  const double path_s = missions_.at(kind_)->limits().resend_path_s;
  return running() && !paused_since_ ? path_s : std::min(path_s, kStandAgain_s);
}

void MissionTable::Decide(Mission& mission) {
  if (const auto stop = StopOf(mission)) {
    blocked_since_.reset();
    mission.OnStop(control_, *stop);
  } else {
    mission.Step(control_);
  }
}

double MissionTable::SilentFor_s(Time now) const {
  const auto& pose = control_.heard().pose;
  return Seconds(now - (pose ? std::max(pose->stamp, control_.started()) : control_.started()));
}

std::optional<double> MissionTable::Silence_s(Time now) const {
  if (!running() || !control_.path_sent()) return std::nullopt;
  const double silent_s = SilentFor_s(now);
  return silent_s > missions_.at(kind_)->limits().silent_s ? std::optional(silent_s) : std::nullopt;
}

/// A robot that has no path yet is not waited for: who ordered learns it at once.
std::optional<std::string> MissionTable::WhySilenceEnds(const Mission& mission) const {
  const double silent_s = mission.limits().silent_s;
  const double limit_s = control_.path_sent() ? std::max(silent_s, blackout_s_) : silent_s;
  if (SilentFor_s(control_.now()) <= limit_s) return std::nullopt;
  return fmt::format("no pose from the robot for {:.0f} s: the radio link is {}", limit_s,
                     control_.heard().link_up ? "up, is the robot running?" : "down");
}

std::optional<std::string> MissionTable::ReasonToEnd(const Mission& mission) const {
  const MissionLimits& limits = mission.limits();
  const Heard& heard = control_.heard();
  const double active_s = Seconds(control_.now() - control_.started() - idle_);
  if (aborted_) return aborted_;
  if (heard.drive)
    if (auto reason = control_.estop_.WhyEnds(*heard.drive)) return reason;
  if (auto reason = WhySilenceEnds(mission)) return reason;
  if (active_s > limits.limit_s)
    return fmt::format("{} after {:.0f} s", mission.Unfinished(), limits.limit_s);
  if (StoodTooLong(mission) && heard.drive->mode == DriveMode::kHolding)
    return fmt::format("the robot held its place for {:.0f} s{}", limits.blocked_s, Because(*heard.drive));
  return std::nullopt;
}

/// Why the robot stands where the mission may find another way.
std::optional<Stop> MissionTable::StopOf(const Mission& mission) {
  const auto& drive = control_.heard().drive;
  if (std::exchange(touched_, false) || (control_.OnPath() && drive->touched))
    return Stop{Stop::Cause::kTouched, "the robot touched something"};
  if (!StoodTooLong(mission)) return std::nullopt;
  return Stop{Stop::Cause::kBlocked, fmt::format("the robot was blocked for {:.0f} s{}",
                                                 mission.limits().blocked_s, Because(*drive))};
}

bool MissionTable::StoodTooLong(const Mission& mission) const {
  return blocked_since_ && Seconds(control_.now() - *blocked_since_) > mission.limits().blocked_s;
}

}  // namespace priamos::planner
