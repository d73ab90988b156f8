#include "planner/core/missions/goto_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

std::string Text(const Pose2& pose) {
  return fmt::format("({:.2f}, {:.2f})", pose.x, pose.y);
}

}  // namespace

void GotoMissionConfig::Describe(Archive& a) {
  a.Number("speed_m_s", speed_m_s, {"m/s", 0.05, 1, "on the way"});
  a.Number("near_m", near_m, {"m", 0.01, 1, "distance to the goal at which the mission is done"});
  a.Number("beside_m", beside_m,
           {"m", 0, 2, "the same where what stands there lets the base come no nearer; 0: never"});
  a.Number("turned_deg", turned_deg, {"deg", 0.5, 45, "difference in heading at which it is done"});
  a.Integer("retries", retries, {"-", 0, 20, "other ways that are tried after something was in the way"});
  a.Number("stands_s", stands_s,
           {"s", 1, 600, "a robot that holds on its way for so long fails the mission"});
  a.Number("idle_s", idle_s, {"s", 1, 600, "a robot that comes no further for so long is blocked"});
  a.Integer("waits", waits, {"-", 0, 100, "times that it waits where there is no other way"});
  a.Number("wait_s", wait_s, {"s", 0.5, 600, "how long it waits for what is in the way to go away"});
  a.Number("thing_m", thing_m, {"m", 0.1, 3, "size that something in the way is taken to have"});
  limits.Describe(a);
  a.Section("route", route, "the way through the room");
  a.Section("keep", keep, "looks on the way that keep the pose known");
}

GotoMission::GotoMission(const GotoMissionConfig& config, const Footprint& footprint, const GroundPlan& plan)
    : config_(config),
      footprint_(footprint),
      planner_(config.route, footprint, plan),
      keeper_(config.keep, plan),
      faces_(FacesOf(plan)) {}

std::optional<Refusal> GotoMission::Start(const MissionOrder& order) {
  goal_ = order.goal;
  departures_ = waits_ = 0;
  waits_since_.reset();
  walls_sent_.reset();
  progress_.Reset();
  planner_.Forget();
  keeper_.Reset();
  learned_.reset();
  const Pose2& there = goal_.map_from_base;
  if (!std::isfinite(there.x) || !std::isfinite(there.y) || !std::isfinite(there.yaw))
    return Refusal{"the goal is no place: its numbers are not finite"};
  return std::nullopt;
}

void GotoMission::Step(MissionControl& control) {
  const Heard& heard = control.heard();
  if (control.state().phase == Phase::kWaiting) {
    if (waits_since_ && control.now() - *waits_since_ < FromSeconds(config_.wait_s)) return;
    if (heard.link_up && heard.pose && IsFresh(*heard.pose, control.now())) Depart(control, "");
    return;
  }
  keeper_.Step(control);
  SendWalls(control);
  const bool is_new = heard.pose->stamp > *control.path_sent();
  if (!is_new || !control.OnPath()) return;
  if (heard.drive->mode == DriveMode::kArrived) {
    // A place that is hardly known is none at which a base could be said to have arrived.
    if (!keeper_.MayHelp(control)) Arrive(control);
    return;
  }
  if (const auto stop = progress_.Step(control, config_.stands_s, config_.idle_s))
    return OnStop(control, *stop);
  if (!control.running()) return;
  Reconsider(control);
}

/// Doors are looked at where there are any: led by both, the base would be drawn to and fro by what the plan
/// has wrong of each.
void GotoMission::SendWalls(MissionControl& control) {
  constexpr double kEvery_s = 5;
  constexpr double kAhead_m = 6;
  if (walls_sent_ && Seconds(control.now() - *walls_sent_) < kEvery_s) return;
  if (!keeper_.NeedsWalls(control) || !control.OnPath()) return;
  std::vector<Eigen::Vector2d> way{control.heard().pose->map_from_base.translation()};
  double length_m = 0;
  for (const Pose2& point : PointsLeft(control.path().points, control.heard().drive->remaining_m)) {
    if (length_m > kAhead_m) break;
    length_m += (point.translation() - way.back()).norm();
    way.push_back(point.translation());
  }
  control.SendFaces(FacesAlong(faces_, way));
  walls_sent_ = control.now();
}

void GotoMission::Learn(const MissionControl& control) {
  learned_ = control.heard().learned;
  if (learned_) planner_.Learn(*learned_, control.heard().pose->map_from_base);
}

/// A wall or a thing that is not on the plan, across the path: another way, if there is one. If there is none
/// the base drives on; it may be able to do what the map does not know, and stops before what is there.
void GotoMission::Reconsider(MissionControl& control) {
  if (learned_ == control.heard().learned) return;
  Learn(control);
  const Pose2& base = control.heard().pose->map_from_base;
  const auto left = PointsLeft(control.path().points, control.heard().drive->remaining_m);
  const std::string obstacle = planner_.InTheWay(base, left);
  if (obstacle.empty()) return;
  if (Outcome<PlannedPath> path = planner_.Plan(base, goal_))
    Drive(control, std::move(*path), "in the way: " + obstacle);
}

/// Where the goal is taken, by what is not on the plan for instance, the first place that does instead.
void GotoMission::ChooseGoal(const Pose2& map_from_base) {
  const auto refused = [&](const Pose2& place) {
    return planner_.CheckEnds(map_from_base, {place, goal_.turn}).has_value();
  };
  if (goal_.instead.empty() || !refused(goal_.map_from_base)) return;
  const auto free = std::find_if_not(goal_.instead.begin(), goal_.instead.end(), refused);
  if (free != goal_.instead.end()) goal_.map_from_base = *free;
}

void GotoMission::Depart(MissionControl& control, const std::string& why) {
  Learn(control);
  ChooseGoal(control.heard().pose->map_from_base);
  Outcome<PlannedPath> path = planner_.Plan(control.heard().pose->map_from_base, goal_);
  if (!path) return WaitOrFail(control, why, path.reason());
  Drive(control, std::move(*path), why);
}

/// What stopped the robot may be somebody, who goes away. Then all that stopped it is forgotten, and the way
/// tried once more; from a goal that is taken by what is on the map nobody is expected to go away.
void GotoMission::WaitOrFail(MissionControl& control, const std::string& why, const std::string& no_way) {
  if (why.empty()) return GiveUp(control, no_way);
  if (++waits_ > config_.waits) return GiveUp(control, why + ", and " + no_way);
  planner_.Forget();
  departures_ = 0;
  waits_since_ = control.now();
  control.OrderPath({}, 0);
  control.Enter(Phase::kWaiting, fmt::format("{}, and {}; waits {:.0f} s for it to go away, {} of {} times",
                                             why, no_way, config_.wait_s, waits_, config_.waits));
}

/// Beside the goal the base is as near as what stands there lets it come, and who sent it will see that.
void GotoMission::GiveUp(MissionControl& control, const std::string& reason) {
  const Pose2& base = control.heard().pose->map_from_base;
  if (!IsWithin(config_.beside_m, base)) return control.Fail(reason);
  control.OrderPath({}, 0);
  const double off_m = (base.translation() - goal_.map_from_base.translation()).norm();
  control.Enter(Phase::kDone, fmt::format("at {}, {:.2f} m beside {}: {}", Text(base), off_m,
                                          Text(goal_.map_from_base), reason));
}

void GotoMission::Drive(MissionControl& control, PlannedPath path, const std::string& why) {
  whole_ = path.points.size() <= kMostPathPoints;
  path = FirstPart(std::move(path));
  const double length_m = LengthOf(control.heard().pose->map_from_base, path.points);
  control.OrderPath(std::move(path), config_.speed_m_s);
  control.Enter(Phase::kDriving,
                fmt::format("{}driving to {}, {:.1f} m{}", why.empty() ? "" : why + "; another way: ",
                            Text(goal_.map_from_base), length_m, whole_ ? "" : " and more"));
}

void GotoMission::Arrive(MissionControl& control) {
  const RobotPose& pose = *control.heard().pose;
  if (IsWithin(config_.near_m, pose.map_from_base)) {
    const double sigma_m = std::sqrt(std::max(pose.covariance(0, 0), pose.covariance(1, 1)));
    return control.Enter(Phase::kDone,
                         fmt::format("at {} after {:.1f} s, known to {:.2f} m", Text(pose.map_from_base),
                                     Seconds(control.now() - control.started()), sigma_m));
  }
  // The first part of a long way; or the pose was corrected, and the goal is elsewhere by now.
  if (whole_ && ++departures_ > config_.retries)
    return control.Fail(fmt::format("the path ended at {}, not at the goal", Text(pose.map_from_base)));
  Depart(control, "");
}

bool GotoMission::IsWithin(double distance_m, const Pose2& map_from_base) const {
  const Pose2 off = goal_.map_from_base.Inverse() * map_from_base;
  const bool turned = !goal_.turn || std::abs(off.yaw) <= Radians(config_.turned_deg);
  return turned && off.translation().norm() <= distance_m;
}

void GotoMission::OnStop(MissionControl& control, const Stop& stop) {
  const bool blocked = stop.cause == Stop::Cause::kBlocked;
  if (blocked && IsWithin(config_.near_m, control.heard().pose->map_from_base)) {
    control.OrderPath({}, 0);  // what is left of the path is not to be driven later
    return Arrive(control);
  }
  if (!blocked) return control.Fail(stop.reason + "; next: look what it is, and order it again");
  if (++departures_ > config_.retries)
    return GiveUp(control, stop.reason + "; next: look what it is, and order it again");
  // A base that came no further and hears nothing has met nothing that could be put on the map. And what was
  // taken for larger than it is may have closed the only way.
  const DriveReport& drive = *control.heard().drive;
  const bool met = drive.mode == DriveMode::kBlocked || drive.nearest;
  if (const auto thing =
          !met ? std::nullopt : ThingAhead(control, footprint_, config_.thing_m / (1 + waits_)))
    planner_.Add("what stopped the robot", *thing);
  Depart(control, stop.reason);
}

}  // namespace priamos::planner
