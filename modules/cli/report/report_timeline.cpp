#include "cli/report/report_timeline.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::cli {
namespace {

Pose2 Between(const Pose2& a, const Pose2& b, double part) {
  return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y),
          WrapAngle(a.yaw + part * WrapAngle(b.yaw - a.yaw))};
}

}  // namespace

std::optional<Pose2> TruthAt(const RunRecord& record, std::int64_t utime) {
  const auto& truth = record.truth;
  const auto after = std::lower_bound(truth.begin(), truth.end(), utime,
                                      [](const world_truth_t& t, std::int64_t at) { return t.utime < at; });
  if (after == truth.end()) return std::nullopt;
  if (after->utime == utime) return PoseOf(*after);
  if (after == truth.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double part = double(utime - before->utime) / double(after->utime - before->utime);
  return Between(PoseOf(*before), PoseOf(*after), part);
}

std::optional<Pose2> BeliefFromTruth(const RunRecord& record, std::int64_t utime) {
  const auto truth = TruthAt(record, utime);
  const auto nearest =
      std::min_element(record.poses.begin(), record.poses.end(), [utime](const pose_t& a, const pose_t& b) {
        return std::abs(a.utime - utime) < std::abs(b.utime - utime);
      });
  if (!truth || nearest == record.poses.end()) return std::nullopt;
  const auto there = TruthAt(record, nearest->utime);
  if (!there) return std::nullopt;
  return Pose2{nearest->x_m, nearest->y_m, nearest->yaw_rad} * there->Inverse();
}

std::optional<PoseError> ErrorOf(const RunRecord& record, const pose_t& pose) {
  const auto truth = TruthAt(record, pose.utime);
  if (!truth) return std::nullopt;
  const Eigen::Vector2d d(pose.x_m - truth->x, pose.y_m - truth->y);
  return PoseError{pose.utime, d.norm(), WrapAngle(pose.yaw_rad - truth->yaw)};
}

std::optional<Crossing> CrossingOf(const RunRecord& record, const Pose2& map_from_door) {
  const Pose2 door_from_map = map_from_door.Inverse();
  std::optional<Pose2> before;
  std::int64_t before_utime = 0;
  for (const world_truth_t& truth : record.truth) {
    const Pose2 now = door_from_map * PoseOf(truth);
    if (before && before->x < 0 && now.x >= 0) {
      const double part = -before->x / (now.x - before->x);
      const Pose2 at = Between(*before, now, part);
      const auto step = static_cast<double>(truth.utime - before_utime);
      return Crossing{before_utime + std::llround(part * step), at.y, at.yaw};
    }
    before = now;
    before_utime = truth.utime;
  }
  return std::nullopt;
}

MissionSpan SpanOf(const RunRecord& record) {
  MissionSpan span;
  if (!record.truth.empty()) span = {record.truth.front().utime, record.truth.back().utime, false};
  if (!record.orders.empty()) span.begin_utime = record.orders.front().utime;
  bool over = false;
  for (const mission_status_t& status : record.mission) {
    const bool was_over = over;
    over = status.phase == mission_status_t::DONE || status.phase == mission_status_t::FAILED;
    if (!over || was_over) continue;
    span.end_utime = status.utime;
    span.done = status.phase == mission_status_t::DONE;
  }
  return span;
}

std::vector<LookSpan> LooksOf(const RunRecord& record) {
  std::vector<LookSpan> looks;
  for (const pose_correction_t& correction : record.corrections) {
    if (correction.verdict != pose_correction_t::APPLIED) continue;
    const auto look = std::find_if(record.looks.begin(), record.looks.end(), [&](const look_request_t& l) {
      return l.request_id == correction.request_id;
    });
    if (look == record.looks.end()) continue;
    looks.push_back({look->utime, correction.utime, look->side, correction});
  }
  return looks;
}

}  // namespace priamos::cli
