#pragma once

#include <cmath>

#include "bus/node.hpp"
#include "cli/report/report_record.hpp"
#include "cli/report/report_summary.hpp"
#include "common/geometry.hpp"

namespace priamos::cli {

inline constexpr std::int64_t kRunBegin = 1'000'000'000;

template <class T>
void Feed(RunRecord& record, Side side, double t_s, std::string_view channel, T message) {
  const std::int64_t utime = kRunBegin + std::llround(t_s * 1e6);
  message.utime = utime;
  const auto bytes = bus::Encode(message);
  record.Add(side, utime, channel, bytes);
}

/// A run made up by hand: from (2.0, 2.1) to (7.5, 2.4) at 0.3 m/s, the belief 15 cm and 4 degrees wrong
/// until two fixes at 4.0 s and 5.0 s take first most of it, then the rest but 1 cm and 0.2 degrees.
struct SyntheticRun {
  double end_s = 19;
  double lateral_m = 0.006;    ///< true y offset at the door
  double heading_rad = 0.004;  ///< true heading at the door
  bool done = true;
  int contacts = 0;

  Pose2 Truth(double t_s) const {
    const double x = 2.0 + 0.3 * std::max(0.0, t_s - 1);
    const double blend = std::min(1.0, std::max(0.0, (x - 2.0) / 2.2));
    const double ease = blend * blend * (3 - 2 * blend);
    return {x, 2.1 + ease * (0.3 + lateral_m), 0.05 * (1 - ease) + ease * heading_rad};
  }
  Pose2 Error(double t_s) const {
    if (t_s < 4.0) return {0.09, -0.12, Radians(4)};
    if (t_s < 5.0) return {0.02, -0.03, Radians(1)};
    return {0.006, 0.008, Radians(0.2)};
  }
  Pose2 Belief(double t_s) const {
    const Pose2 truth = Truth(t_s), error = Error(t_s);
    return {truth.x + error.x, truth.y + error.y, truth.yaw + error.yaw};
  }

  void FeedMotion(RunRecord& record, double t_s) const {
    const Pose2 truth = Truth(t_s), belief = Belief(t_s);
    world_truth_t world{};
    world.x_m = truth.x;
    world.y_m = truth.y;
    world.yaw_rad = truth.yaw;
    world.vx_m_s = t_s > 1 ? 0.3 : 0;
    world.gap_m = std::abs(truth.x - 6) < 0.6 ? 0.052 : 1;
    world.min_gap_m = truth.x > 5.5 ? 0.052 : 0.8;
    world.contacts = contacts;
    Feed(record, Side::kOnboard, t_s, "WORLD_TRUTH", world);
    pose_t pose{};
    pose.x_m = belief.x;
    pose.y_m = belief.y;
    pose.yaw_rad = belief.yaw;
    const bool before = t_s < 4, between = t_s < 5;
    pose.sigma_x_m = before ? 0.10 : between ? 0.03 : 0.010 + 0.001 * (t_s - 5);
    pose.sigma_y_m = before ? 0.10 : between ? 0.04 : 0.008 + 0.001 * (t_s - 5);
    pose.sigma_yaw_rad = Radians(before ? 2.5 : between ? 0.8 : 0.2);
    pose.rho_x_y = before ? 0 : 0.3;
    Feed(record, Side::kOnboard, t_s, "POSE", pose);
  }

  void FeedFix(RunRecord& record, int id, int side, double asked_s, double corrected_s,
               double sigma_m) const {
    look_request_t look{};
    look.request_id = id;
    look.landmark_id = 1;
    look.side = static_cast<std::int8_t>(side);
    Feed(record, Side::kOffboard, asked_s, "LOOK_REQUEST", look);
    pose_correction_t correction{};
    correction.request_id = id;
    correction.sigma_m = sigma_m;
    correction.sigma_yaw_rad = sigma_m / 3;
    Feed(record, Side::kOnboard, corrected_s, "POSE_CORRECTION", correction);
  }

  void FeedStatus(RunRecord& record, double t_s, std::int8_t phase, const char* text) const {
    mission_status_t status{};
    status.phase = phase;
    status.text = text;
    Feed(record, Side::kOffboard, t_s, "MISSION_STATUS", status);
  }

  void FeedLink(RunRecord& record, double t_s) const {
    link_status_t link{};
    link.up = true;
    link.utilisation = 0.2;
    link.bytes_sent = static_cast<std::int64_t>(200 * t_s);
    link.frames_sent = static_cast<std::int32_t>(8 * t_s);
    link.dropped = 2;
    link_channel_t pose{};
    pose.channel = "POSE";
    pose.outgoing = true;
    pose.messages = static_cast<std::int32_t>(4 * t_s);
    pose.bytes = 26 * pose.messages;
    link_channel_t path{};
    path.channel = "PATH";
    link.channels = {pose, path};
    link.n_channels = 2;
    Feed(record, Side::kOnboard, t_s, "LINK_STATUS", link);
    link.utilisation = 0.05;
    link.channels[0].channel = "LOOK_REQUEST";
    Feed(record, Side::kOffboard, t_s, "LINK_STATUS", link);
  }

  RunRecord Record() const {
    RunRecord record;
    mission_command_t order{};
    order.mission = mission_command_t::PASS_DOOR;
    Feed(record, Side::kOffboard, 0.5, "MISSION_COMMAND", order);
    FeedStatus(record, 0.6, mission_status_t::APPROACHING, "approaching");
    for (int i = 0; i <= std::lround(end_s * 50); ++i) FeedMotion(record, i / 50.0);
    FeedFix(record, 11, 1, 3.3, 4.0, 0.035);
    FeedFix(record, 12, 2, 4.2, 5.0, 0.010);
    for (int i = 1; i < end_s; ++i) FeedLink(record, i);
    for (int i = 1; i < 4 * end_s; ++i) {
      pose_t pose{};
      pose.utime = kRunBegin + i * 250'000;
      record.Add(Side::kOffboard, pose.utime + 180'000, "POSE", bus::Encode(pose));
    }
    FeedStatus(record, end_s - 0.5, done ? mission_status_t::DONE : mission_status_t::FAILED, "the end");
    return record;
  }
};

inline DoorPlan TestDoor() {
  DoorPlan door;
  door.name = "laboratory";
  door.x_m = 6;
  door.y_m = 2.4;
  return door;
}

inline RunInfo TestInfo() {
  return {"door", 7, 12.5, TestDoor(), {}, {}, {}};
}

}  // namespace priamos::cli
