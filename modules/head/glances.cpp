#include "head/glances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "common/archive.hpp"

namespace priamos::head {
namespace {

/// A base that is slower stands. One that is farther on than this from one pose to the next was put
/// elsewhere.
constexpr double kDrives_m_s = 0.05, kJump_m = 0.3;
/// Less is the noise of a pose that goes on.
constexpr double kCorrected_m = 0.01, kCorrected_rad = 0.004;

/// The thing whose turn it is, of `tellables`; nullptr: none.
template <class Tracks>
auto WhoseTurn(const Tracks& things, TurnTaking& turns, Time now, std::span<const Tellable> tellables)
    -> decltype(things.tracks().data()) {
  const auto id = turns.Next(tellables, now);
  if (!id) return nullptr;
  return &*std::ranges::find_if(things.tracks(), [&](const auto& track) { return track.id == *id; });
}

}  // namespace

Glances::Glances(const HeadConfig& config, const HeadModel& head, bus::Context& context)
    : base_(config.LookSetting()),
      aside_(config.doors),
      ahead_(config.scene),
      evaluator_(head, {}),
      path_(context.node().Subscribe(channels::kPath)),
      door_found_(context.node().Advertise(channels::kDoorFound)),
      scene_object_(context.node().Advertise(channels::kSceneObject)) {
  if (!config.doors.corridors || config.mode == "calibrate") return;
  for (const Camera camera : {kLeft, kRight}) {
    const auto model = head.CameraAt(aside_.SettingAt(0, base_), camera);
    if (!model)
      throw ConfigError(
          fmt::format("doors.zoom_step: {} camera: {}; calibrate it with `priamos-head "
                      "--calibrate`, or set doors.corridors = false",
                      kCameraNames[camera], model.reason()));
  }
}

void Glances::OnPose(const PoseSample& pose) {
  if (pose_) {
    const Pose2 expected = Integrate(pose_->map_from_base, pose_->twist, Seconds(pose.time - pose_->time));
    Correct({pose.time, pose.map_from_base * expected.Inverse()});
  }
  pose_ = pose;
}

/// From one pose to the next the base moves as it says, within the noise of its speed; the rest is a
/// correction.
void Glances::Correct(const Correction& correction) {
  const Pose2& moved = correction.new_from_old;
  const double jump_m =
      (moved * pose_->map_from_base.translation() - pose_->map_from_base.translation()).norm();
  if (jump_m > kJump_m) {
    doors_.Forget();
    door_turns_.Forget();
    objects_.Forget();
    object_turns_.Forget();
    urgent_turns_.Forget();
    corrected_.reset();
  } else if (jump_m > kCorrected_m || std::abs(moved.yaw) > kCorrected_rad) {
    doors_.Move(moved);
    objects_.Move(moved);
    corrected_ = correction;
  }
}

/// From where a picture was taken, as it is known since the pose was corrected.
Pose2 Glances::PlaceOf(const PoseSample& robot) const {
  const bool before = corrected_ && robot.time < corrected_->at;
  return before ? corrected_->new_from_old * robot.map_from_base : robot.map_from_base;
}

/// Whether the base is driving on a path, along a corridor or another one. It needs no word over the radio.
bool Glances::Follows(bool corridor) const {
  const path_t* path = path_.get();
  return path && path->centre == corridor && path->n_points > 0 && pose_ &&
         std::hypot(pose_->twist.vx, pose_->twist.vy) > kDrives_m_s;
}

/// Where the base drives to, from its own front; in turn with half of that, because a base that drives
/// askew meets things with its corner.
double Glances::Bearing() const {
  const double bearing = pose_ ? std::atan2(pose_->twist.vy, pose_->twist.vx) : 0;
  return halfway_ ? bearing / 2 : bearing;
}

std::optional<HeadSetting> Glances::Next(bool needed, bool glancing, Time now) {
  const auto pan = aside_.Step(needed, glancing, Follows(true), now);
  const bool ahead = ahead_.Step(needed, glancing || pan, Follows(false), now);
  if (!pan && !ahead) return std::nullopt;
  to_the_side_ = pan.has_value();
  halfway_ = !halfway_;
  return pan ? aside_.SettingAt(*pan, base_) : ahead_.SettingFrom(base_, Bearing());
}

void Glances::Add(const std::array<std::optional<GreyImage>, 3>& pictures, const HeadSetting& setting,
                  const PoseSample& robot) {
  const Glance glance = evaluator_.Evaluate(pictures, setting, to_the_side_);
  doors_.Add(glance.doors, PlaceOf(robot), robot.time);
  Add(glance.scene, robot);
}

void Glances::Add(const Scene& scene, const PoseSample& robot) {
  objects_.Add(scene, PlaceOf(robot), robot.time);
}

void Glances::Tell(Time now) {
  if (const DoorTrack* door = WhoseTurn(doors_, door_turns_, now, doors_.Tellables(now)))
    door_found_.Publish(ToMessage(*door, doors_.StateOf(*door)));
  // The base brakes before what hangs by itself: it is to know at once, whatever the radio carries.
  if (const SceneTrack* object = WhoseTurn(objects_, urgent_turns_, now, objects_.Urgent(now)))
    scene_object_.Publish(ToMessage(*object, objects_.HasGone(*object)));
  if (const SceneTrack* object = WhoseTurn(objects_, object_turns_, now, objects_.Tellables(now)))
    scene_object_.Publish(ToMessage(*object, objects_.HasGone(*object)));
}

}  // namespace priamos::head
