#include "cli/report/report_corridor.hpp"

#include <algorithm>
#include <cmath>

#include "cli/report/report_timeline.hpp"

namespace priamos::cli {
namespace {

/// A robot has to hear its walls before it can know better than it was told.
constexpr double kBegin_m = 3;

bool FollowsCorridor(const mission_command_t& order) {
  return order.mission == mission_command_t::CORRIDOR;
}

double ErrorAcross(const pose_t& pose, const Pose2& truth) {
  return (truth.Inverse() * Eigen::Vector2d(pose.x_m, pose.y_m)).y();
}

}  // namespace

std::optional<CorridorSummary> CorridorSummaryOf(const RunRecord& record) {
  if (std::none_of(record.orders.begin(), record.orders.end(), FollowsCorridor)) return std::nullopt;
  const MissionSpan span = SpanOf(record);
  CorridorSummary summary;
  double squares = 0;
  int n = 0;
  std::optional<Pose2> last;
  for (const pose_t& pose : record.poses) {
    const auto truth = TruthAt(record, pose.utime);
    if (!truth || pose.utime < span.begin_utime || pose.utime > span.end_utime) continue;
    if (last) summary.driven_m += (truth->translation() - last->translation()).norm();
    last = truth;
    if (summary.driven_m < kBegin_m) continue;
    squares += std::pow(ErrorAcross(pose, *truth), 2);
    ++n;
  }
  if (n > 0) summary.across_rms_m = std::sqrt(squares / n);
  if (!last) return summary;
  DoorPlan frame;
  frame.yaw_deg = Degrees(last->yaw);
  summary.end = BeliefAt(record, frame, span.end_utime);
  return summary;
}

}  // namespace priamos::cli
