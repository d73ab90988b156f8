#include "head/door_search.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/archive.hpp"

namespace priamos::head {
namespace {

/// A base that is slower stands. One that is farther on than this from one pose to the next was put
/// elsewhere.
constexpr double kDrives_m_s = 0.05, kJump_m = 0.3;

}  // namespace

DoorSearch::DoorSearch(const HeadConfig& config, const HeadModel& head, bus::Context& context)
    : base_(config.LookSetting()),
      watch_(config.doors),
      evaluator_(head, {}),
      path_(context.node().Subscribe(channels::kPath)),
      found_(context.node().Advertise(channels::kDoorFound)) {
  if (!config.doors.corridors || config.mode == "calibrate") return;
  for (const Camera camera : {kLeft, kRight}) {
    const auto model = head.CameraAt(watch_.SettingAt(0, base_), camera);
    if (!model)
      throw ConfigError(
          fmt::format("doors.zoom_step: {} camera: {}; calibrate it with `priamos-head "
                      "--calibrate`, or set doors.corridors = false",
                      kCameraNames[camera], model.reason()));
  }
}

void DoorSearch::OnPose(const PoseSample& pose) {
  const bool jumped =
      pose_ && (pose.map_from_base.translation() - pose_->map_from_base.translation()).norm() > kJump_m;
  pose_ = pose;
  if (!jumped) return;
  doors_.Forget();
  news_.Forget();
}

/// Whether the newest path leads along a corridor and the base is driving. It needs no word over the radio.
bool DoorSearch::FollowsCorridor() const {
  const path_t* path = path_.get();
  return path && path->centre && path->n_points > 0 && pose_ &&
         std::hypot(pose_->twist.vx, pose_->twist.vy) > kDrives_m_s;
}

std::optional<HeadSetting> DoorSearch::Next(bool needed, bool glancing, Time now) {
  const auto pan = watch_.Step(needed, glancing, FollowsCorridor(), now);
  if (!pan) return std::nullopt;
  return watch_.SettingAt(*pan, base_);
}

void DoorSearch::Add(const std::array<std::optional<GreyImage>, 2>& pictures, const HeadSetting& setting,
                     const PoseSample& robot) {
  doors_.Add(evaluator_.Evaluate(pictures, setting), robot.map_from_base, robot.time);
}

void DoorSearch::Tell(Time now) {
  const auto door = news_.Next(doors_, now);
  if (door) found_.Publish(ToMessage(*door, doors_.StateOf(*door)));
}

}  // namespace priamos::head
