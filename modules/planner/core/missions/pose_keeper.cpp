#include "planner/core/missions/pose_keeper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/principal_axes.hpp"
#include "planner/core/map/door_sides.hpp"
#include "planner/core/map/map_landmarks.hpp"

namespace priamos::planner {
namespace {

/// The radio takes so long for a model, at most ...
constexpr double kArrives_s = 4;
/// ... and has room for one in so long.
constexpr double kLesson_s = 10;

/// A door nearer than this is passed before its model has arrived.
constexpr double kInTime_m = 2.6;

}  // namespace

void PoseKeeperConfig::Describe(Archive& a) {
  a.Number("sigma_m", sigma_m, {"m", 0.005, 2, "standard deviation of the position that asks for a look"});
  a.Number("nearest_m", nearest_m, {"m", 0.5, 10, "distance to a door from which on it is looked at"});
  a.Number("farthest_m", farthest_m, {"m", 0.5, 20, "distance to a door up to which it is looked at"});
  if (nearest_m > farthest_m) a.Refuse("nearest_m", "at most farthest_m");
  a.Number("most_slant_deg", most_slant_deg, {"deg", 5, 80, "between the door's axis and the line to it"});
  a.Number("most_bearing_deg", most_bearing_deg, {"deg", 5, 180, "between the base's heading and that line"});
  a.Number("pause_s", pause_s, {"s", 1, 600, "after looks that failed"});
  a.Number("teach_m", teach_m, {"m", 0, 100, "distance to doors ahead of which the head is sent a model"});
}

PoseKeeper::PoseKeeper(const PoseKeeperConfig& config, const GroundPlan& plan)
    : config_(config), plan_(plan), doors_(DoorSides(plan)), looks_(LookConfig{}) {}

void PoseKeeper::Reset() {
  looks_.Reset();
  door_ = nullptr;
  gave_up_.reset();
}

/// The head is to know a door by the time that it is looked at.
void PoseKeeper::Teach(MissionControl& control) {
  const auto& pose = control.heard().pose;
  if (!pose || control.now() < next_lesson_) return;
  const DoorPlan* door = NearestUntaught(pose->map_from_base);
  if (!door) return;
  control.SendModel(*MakeLandmark(plan_, door->id));
  taught_[door->id] = control.now();
  next_lesson_ = control.now() + FromSeconds(kLesson_s);
}

/// The head was started anew, or the model got lost.
void PoseKeeper::Forgot(int door_id) {
  taught_.erase(door_id);
  next_lesson_ = {};
}

/// Of the doors ahead, from that side from which they will be seen: the nearest one for which there is time,
/// or the nearest one.
const DoorPlan* PoseKeeper::NearestUntaught(const Pose2& map_from_base) const {
  const DoorPlan* nearest = nullptr;
  double best = std::numeric_limits<double>::infinity();
  for (const DoorPlan& door : doors_) {
    const bool is_before = (door.map_from_door().Inverse() * map_from_base).x < 0;
    const bool is_ahead = (map_from_base.Inverse() * door.map_from_door()).x > 0;
    if (!is_before || !is_ahead || taught_.contains(door.id)) continue;
    const double off_m = (door.map_from_door().translation() - map_from_base.translation()).norm();
    const double rank = off_m < kInTime_m ? config_.teach_m + off_m : off_m;
    if (off_m > config_.teach_m || rank >= best) continue;
    nearest = &door;
    best = rank;
  }
  return nearest;
}

void PoseKeeper::Step(MissionControl& control) {
  for (const LookResult& result : control.heard().looks) looks_.OnResult(result);
  const auto result = looks_.Settle(control.now());
  if (result && !result->ok && result->no_model) Forgot(door_->id);
  Teach(control);
  if (looks_.Exhausted() && !gave_up_) gave_up_ = control.now();
  if (gave_up_ && Seconds(control.now() - *gave_up_) > config_.pause_s) Reset();
  if (gave_up_ || !looks_.Ready(control.now()) || !IsNeeded(control)) return;
  const DoorPlan* door = DoorInSight(control.heard().pose->map_from_base);
  const auto taught = door ? taught_.find(door->id) : taught_.end();
  if (taught == taught_.end() || Seconds(control.now() - taught->second) < kArrives_s) return;
  door_ = door;
  looks_.Asked(control.OrderLook(door->id, looks_.next()), control.now());
}

bool PoseKeeper::MayHelp(const MissionControl& control) const {
  return IsNeeded(control) && !gave_up_ && DoorInSight(control.heard().pose->map_from_base);
}

bool PoseKeeper::NeedsWalls(const MissionControl& control) const {
  return IsNeeded(control) && !DoorInSight(control.heard().pose->map_from_base);
}

bool PoseKeeper::IsNeeded(const MissionControl& control) const {
  const auto& pose = control.heard().pose;
  return pose && IsFresh(*pose, control.now()) && PositionSigma(pose->covariance) > config_.sigma_m;
}

const DoorPlan* PoseKeeper::DoorInSight(const Pose2& map_from_base) const {
  const DoorPlan* nearest = nullptr;
  double nearest_m = config_.farthest_m;
  for (const DoorPlan& door : doors_) {
    const Eigen::Vector2d there = (door.map_from_door().Inverse() * map_from_base).translation();
    const Eigen::Vector2d here = (map_from_base.Inverse() * door.map_from_door()).translation();
    const double distance_m = there.norm();
    const bool in_sight = distance_m >= config_.nearest_m && distance_m <= nearest_m &&
                          std::atan2(std::abs(there.y()), -there.x()) <= Radians(config_.most_slant_deg) &&
                          std::abs(std::atan2(here.y(), here.x())) <= Radians(config_.most_bearing_deg);
    if (!in_sight) continue;
    nearest = &door;
    nearest_m = distance_m;
  }
  return nearest;
}

}  // namespace priamos::planner
