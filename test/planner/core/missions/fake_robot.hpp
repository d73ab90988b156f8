#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "planner/core/missions/mission_table.hpp"

namespace priamos::planner {

/// A robot behind a slow radio, as a mission sees it: follows paths exactly, answers looks, and everything in
/// both directions takes `delay`. It believes to be where `error` puts it until both looks are through.
class FakeRobot {
 public:
  FakeRobot(MissionTable& mission, const Pose2& truth) : mission_(mission), truth_(truth) {}

  /// One time step of what drives it, and whether that is under way: the missions alone, or what orders them.
  std::function<MissionActions(Time)> tick = [this](Time now) { return mission_.Tick(now); };
  std::function<bool()> running = [this] { return mission_.running(); };

  Duration delay = std::chrono::milliseconds(200);
  Duration look_time = std::chrono::milliseconds(700);
  /// Error of the believed pose, in the base frame, until a fix takes it away.
  Pose2 error{0, 0, 0};
  double sigma_m = 0.1, sigma_yaw_rad = Radians(2);
  double sigma_after_m = 0.008, sigma_yaw_after_rad = Radians(0.15);
  /// The answer to the n-th look (from 0); all succeed by default.
  std::function<LookResult(const LookOrder&, int n)> answer = [](const LookOrder& look, int) {
    return LookResult{look.request_id, true, "", false};
  };
  /// The leaf that every look shows; none by default.
  std::optional<LeafSighting> leaf;
  bool silent = false;   ///< nothing comes through in either direction
  bool blocked = false;  ///< stands before an obstacle
  bool idle = false;     ///< stands on its way although nothing holds it
  bool by_echo = false;  ///< so it does because of an echo, but does not say that it is blocked
  bool by_hand = false;  ///< an operator has the lease
  bool lost = false;     ///< holds, because it does not know where it is
  bool touched = false;  ///< stands because it touched something
  bool deaf = false;     ///< its sonars notice no opening
  Pose2 map_from_door{6, 2.4, 0};

  /// One step of 50 ms: robot, radio, mission.
  void Step() {
    now_ += kStep;
    Drive();
    AnswerLooks();
    if (++ticks_ % 5 == 0) Report();
    Deliver();
    const MissionActions actions = tick(now_);
    if (silent) return;
    if (actions.model) ++models_received;
    if (actions.path) Later([this, path = *actions.path] { OnPath(path); });
    if (actions.place) Later([this, place = *actions.place] { OnPlace(place); });
    if (actions.look) Later([this, look = *actions.look] { looks_.push_back({look, now_ + look_time}); });
  }
  void RunFor(double seconds) {
    for (const Time end = now_ + FromSeconds(seconds); now_ < end && running();) Step();
  }
  void RunUntil(Phase phase, double limit_s = 60) {
    for (const Time end = now_ + FromSeconds(limit_s); now_ < end && mission_.state().phase != phase;) Step();
  }

  void RunUntilX(double x_m, double limit_s = 60) {
    for (const Time end = now_ + FromSeconds(limit_s); now_ < end && truth_.x < x_m;) Step();
  }

  Time now() const { return now_; }
  const Pose2& truth() const { return truth_; }
  Pose2 Believed() const { return truth_ * error; }
  double speed_m_s() const { return velocity_.translation().norm() / Seconds(kStep); }

  int models_received = 0;
  std::vector<PathOrder> paths;
  std::vector<PlaceOrder> places;
  std::vector<LookOrder> looks;         ///< in the order they were asked
  std::vector<double> look_distance_m;  ///< true distance to the door at each exposure
  std::vector<double> look_speed_m_s;   ///< speed at each exposure
  double nearest_before_fix_m = 100;    ///< smallest true distance to the door before both fixes

 private:
  static constexpr Duration kStep = std::chrono::milliseconds(50);
  struct Delivery {
    Time at;
    std::function<void()> action;
  };
  struct PendingLook {
    LookOrder look;
    Time done;
  };

  void Later(std::function<void()> action) { radio_.push_back({now_ + delay, std::move(action)}); }
  void Deliver() {
    while (!radio_.empty() && radio_.front().at <= now_) {
      const auto action = std::move(radio_.front().action);
      radio_.pop_front();
      if (!silent) action();
    }
  }

  /// Takes its pose from an order, as the robot does that stands.
  void OnPlace(const PlaceOrder& place) {
    places.push_back(place);
    error = truth_.Inverse() * place.map_from_base;
    sigma_m = place.sigma_m;
    sigma_yaw_rad = std::min(0.5, place.sigma_yaw_rad);
    Later([this, id = place.request_id, stamp = now_] {
      mission_.OnLook({.request_id = id, .placed = true});
      mission_.OnCorrected(stamp);
    });
  }

  void OnPath(const PathOrder& path) {
    paths.push_back(path);
    route_.assign(path.points.begin(), path.points.end());
    path_id_ = path.path_id;
    touched = false;  // reported of the motion that it ended
  }

  /// Moves the truth by what brings the belief along the path.
  void Drive() {
    velocity_ = {};
    if (route_.empty() || blocked || idle || by_echo || touched || lost) return;
    const Pose2 believed = Believed();
    Pose2 next = believed;
    for (double left_m = paths.back().speed_m_s * Seconds(kStep); left_m > 0 && !route_.empty();)
      left_m = MoveTowards(route_.front(), left_m, next);
    velocity_ = believed.Inverse() * next;
    const Pose2 before = map_from_door.Inverse() * truth_;
    truth_ = truth_ * error * velocity_ * error.Inverse();
    const Pose2 after = map_from_door.Inverse() * truth_;
    if (!deaf && (before.x < 0) != (after.x < 0) && std::abs(after.y) < 0.5)
      Later([this, opening = PassedOpening{now_, Believed(), 0.95}] { mission_.OnOpening(opening); });
    if (good_looks_ < 2) nearest_before_fix_m = std::min(nearest_before_fix_m, 6.0 - truth_.x);
  }

  /// Returns what is left of the step when the point is reached before its end.
  double MoveTowards(const Pose2& to, double step_m, Pose2& pose) {
    const double way_m = (to.translation() - pose.translation()).norm();
    if (way_m <= step_m) {
      pose = to;
      route_.pop_front();
      return step_m - way_m;
    }
    const double part = step_m / way_m;
    pose = {pose.x + part * (to.x - pose.x), pose.y + part * (to.y - pose.y),
            pose.yaw + part * WrapAngle(to.yaw - pose.yaw)};
    return 0;
  }

  double Remaining() const {
    double remaining_m = 0;
    Eigen::Vector2d from = Believed().translation();
    for (const Pose2& to : route_) {
      remaining_m += (to.translation() - from).norm();
      from = to.translation();
    }
    return remaining_m;
  }

  void AnswerLooks() {
    if (looks_.empty() || looks_.front().done > now_) return;
    const LookOrder look = looks_.front().look;
    looks_.pop_front();
    const LookResult result = answer(look, static_cast<int>(looks.size()));
    looks.push_back(look);
    look_distance_m.push_back(6.0 - truth_.x);
    look_speed_m_s.push_back(speed_m_s());
    if (result.ok && ++good_looks_ == 1) error = {error.x / 4, error.y / 4, error.yaw / 4};
    if (result.ok && good_looks_ >= 2) {
      error = {};
      sigma_m = sigma_after_m;
      sigma_yaw_rad = sigma_yaw_after_rad;
    }
    if (result.ok && leaf) {
      leaf->stamp = now_;
      Later([this, leaf = *leaf] { mission_.OnLeaf(leaf); });
    }
    Later([this, result, stamp = now_] {
      mission_.OnLook(result);
      if (result.ok) mission_.OnCorrected(stamp);
    });
  }

  void Report() {
    RobotPose pose{now_, Believed(), {}, Eigen::Matrix3d::Zero()};
    pose.velocity = {velocity_.x / Seconds(kStep), velocity_.y / Seconds(kStep), 0};
    pose.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_yaw_rad * sigma_yaw_rad;
    DriveReport drive{paths.empty()    ? DriveMode::kIdle
                      : route_.empty() ? DriveMode::kArrived
                                       : DriveMode::kFollowing,
                      path_id_,
                      blocked   ? "sonar"
                      : lost    ? "the pose is too uncertain or too old"
                      : by_echo ? "an echo is too near"
                                : "",
                      false,
                      0,
                      touched,
                      Remaining(),
                      std::nullopt};
    drive.by_hand = by_hand;
    drive.by_echo = by_echo;
    if (blocked) drive.mode = DriveMode::kBlocked;
    if (touched) drive.mode = DriveMode::kHolding;
    Later([this, pose, drive] {
      mission_.OnPose(pose);
      mission_.OnDrive(drive, now_);
      mission_.OnLink(true);
    });
  }

  MissionTable& mission_;
  Pose2 truth_;
  Pose2 velocity_;
  Time now_ = FromUtime(1'000'000'000);
  int ticks_ = 0, path_id_ = 0, good_looks_ = 0;
  std::deque<Pose2> route_;
  std::deque<PendingLook> looks_;
  std::deque<Delivery> radio_;
};

}  // namespace priamos::planner
