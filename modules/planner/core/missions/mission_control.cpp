#include "planner/core/missions/mission_control.hpp"

#include <utility>

namespace priamos::planner {
namespace {

/// Path and request numbers as the messages carry them.
constexpr int kNumbers = 65535;

}  // namespace

void MissionControl::Begin(Time now) {
  now_ = started_ = now;
  running_ = true;
  path_sent_.reset();
  heard_.corrected.reset();
  heard_.looks.clear();
  // Numbers begin with the clock, so that an answer meant for an earlier planner process is not taken for
  // ours.
  if (last_number_ == 0) last_number_ = 1 + static_cast<int>(ToUtime(now) / 1'000'000 % kNumbers);
  Enter(Phase::kWaiting, "waiting for the robot's pose");
}

void MissionControl::Fail(std::string reason) {
  Enter(Phase::kFailed, std::move(reason));
  actions_ = {};
  OrderPath({}, 0);
}

void MissionControl::OrderPath(std::vector<Pose2> points, double speed_m_s) {
  path_ = {NextNumber(), speed_m_s, std::move(points)};
  path_sent_ = now_;
  actions_.path = path_;
}

int MissionControl::OrderLook(int landmark_id, Side side) {
  actions_.look = LookOrder{NextNumber(), landmark_id, side};
  return actions_.look->request_id;
}

void MissionControl::RepeatUnconfirmedPath(double after_s) {
  if (!path_sent_ || OnPath() || Seconds(now_ - *path_sent_) < after_s) return;
  path_sent_ = now_;
  actions_.path = path_;
}

int MissionControl::NextNumber() {
  return last_number_ = last_number_ % kNumbers + 1;
}

}  // namespace priamos::planner
