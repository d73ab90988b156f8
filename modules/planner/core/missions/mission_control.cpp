#include "planner/core/missions/mission_control.hpp"

#include <utility>

#include "planner/core/missions/path_remainder.hpp"

namespace priamos::planner {
namespace {

/// Path and request numbers as the messages carry them.
constexpr int kNumbers = 65535;
/// A place that is not known is said again; on the radio POSE_RESET has 4 s.
constexpr double kPlaceAgain_s = 5;
constexpr int kMostPlaceRepeats = 5;
/// A robot that takes no path, for somebody drives it by hand, is not told for ever.
constexpr int kMostRepeats = 10;

}  // namespace

void MissionControl::Begin(Time now) {
  now_ = started_ = now;
  running_ = true;
  path_sent_.reset();
  path_ids_.clear();
  held_.reset();
  heard_.corrected.reset();
  heard_.opening.reset();
  heard_.looks.clear();
  heard_.told.clear();
  place_.reset();
  place_refused_ = false;
  // The order stands on what its operator could know: a stop that is not reported yet came after it.
  estop_ = EstopWatch(heard_.drive);
  NumberFrom(now);
  Enter(Phase::kWaiting, "waiting for the robot's pose");
  faces_are_own_ = false;
}

/// Numbers begin with the clock, so that an answer meant for an earlier planner process is not taken for
/// ours.
void MissionControl::NumberFrom(Time now) {
  if (last_number_ == 0) last_number_ = 1 + static_cast<int>(ToUtime(now) / 1'000'000 % kNumbers);
}

void MissionControl::NoteDrive(const DriveReport& drive) {
  heard_.drive = drive;
  if (OnPath()) remaining_m_ = drive.remaining_m;
  estop_.Note(drive);
}

void MissionControl::Fail(std::string reason) {
  Enter(Phase::kFailed, std::move(reason));
  // Not the walls of the plan: the robot is taken to have them.
  actions_.model.reset();
  actions_.look.reset();
  OrderPath({}, 0);
}

void MissionControl::OrderPath(PlannedPath path, double speed_m_s) {
  // Walls of the plan are as wrong as its doors: who is led by a door is not to be led by them as well.
  if (!faces_are_own_ && !path.points.empty()) SendFaces({});
  path_ = {.path_id = NextNumber(),
           .speed_m_s = speed_m_s,
           .points = std::move(path.points),
           .leeway = std::move(path.leeway),
           .centre = path.centre};
  path_ids_.insert(path_.path_id);
  path_start_ = heard_.pose ? heard_.pose->map_from_base : Pose2{};
  remaining_m_ = LengthOf(path_start_, path_.points);
  n_stand_repeats_ = 0;
  SendPath();
}

void MissionControl::Stand(Time now) {
  now_ = now;
  NumberFrom(now);
  OrderPath({}, 0);
}

void MissionControl::RepeatUnconfirmedStand(Time now, double after_s) {
  if (running() || !path_.points.empty() || n_stand_repeats_ >= kMostRepeats) return;
  if (!path_sent_ || !heard_.pose || !IsFresh(*heard_.pose, now)) return;
  if (OnPath()) {
    path_sent_.reset();
  } else if (Seconds(now - *path_sent_) >= after_s) {
    ++n_stand_repeats_;
    SendPath();
  }
}

void MissionControl::Hold() {
  if (path_sent_) held_ = Held{path_, path_start_, remaining_m_};
  OrderPath({}, 0);
}

void MissionControl::GoOn() {
  if (!held_) return path_sent_.reset();  // the mission has driven nothing yet
  const Held held = *std::exchange(held_, std::nullopt);
  PathOrder left = held.path;
  if (heard_.pose) left = RemainderOf(held.path, held.start, held.remaining_m, heard_.pose->map_from_base);
  PlannedPath path;
  path.points = std::move(left.points);
  path.leeway = std::move(left.leeway);
  path.centre = left.centre;
  OrderPath(std::move(path), held.path.speed_m_s);
}

void MissionControl::SendPath() {
  path_.estop_changes = estop_.changes();
  path_sent_ = now_;
  actions_.path = path_;
}

void MissionControl::SendFaces(std::vector<WallFace> faces) {
  faces_are_own_ = true;
  if (faces == faces_) return;
  faces_ = std::move(faces);
  actions_.faces = faces_;
  faces_sent_ = now_;
}

/// Whether they came is not told: an order that is lost on the radio, or by a robot that starts anew, costs
/// so long.
void MissionControl::RepeatFaces() {
  constexpr double kEvery_s = 10;
  if (!faces_sent_ || Seconds(now_ - *faces_sent_) < kEvery_s) return;
  actions_.faces = faces_;
  faces_sent_ = now_;
}

void MissionControl::OrderPlace(const Pose2& map_from_base, double sigma_m, double sigma_yaw_rad) {
  OrderPath({}, 0);
  place_ = PlaceOrder{NextNumber(), map_from_base, sigma_m, sigma_yaw_rad};
  place_sent_ = now_;
  n_place_repeats_ = 0;
  place_refused_ = false;
  actions_.place = place_;
}

/// A base that still moved has refused it: each time it is a new order.
void MissionControl::RepeatPlace() {
  if (!place_ || Seconds(now_ - place_sent_) < kPlaceAgain_s) return;
  if (n_place_repeats_ >= kMostPlaceRepeats) {
    place_.reset();
    place_refused_ = true;
    return;
  }
  ++n_place_repeats_;
  place_->request_id = NextNumber();
  place_sent_ = now_;
  actions_.place = place_;
}

void MissionControl::NotePlaced(const LookResult& result) {
  if (place_ && result.placed && result.request_id == place_->request_id) place_.reset();
}

int MissionControl::OrderLook(int landmark_id, Side side) {
  actions_.look = LookOrder{NextNumber(), landmark_id, side};
  return actions_.look->request_id;
}

void MissionControl::RepeatUnconfirmedPath(double after_s) {
  if (!path_sent_ || OnPath() || Seconds(now_ - *path_sent_) < after_s) return;
  SendPath();
}

int MissionControl::NextNumber() {
  return last_number_ = last_number_ % kNumbers + 1;
}

}  // namespace priamos::planner
