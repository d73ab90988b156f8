#include "planner/core/missions/explore_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/core/explore/passages.hpp"

namespace priamos::planner {
namespace {

/// Frontiers to which a way is looked for in one time step.
constexpr int kMostTries = 5;
/// A base that is stopped so near to where it was stopped before is shut in, and goes back so far; in the end
/// also one that stands so near to it.
constexpr double kSamePlace_m = 0.3, kBack_m = 1.5, kShutIn_m = 1.0;
/// A round that saw no more than so much more has seen nothing.
constexpr double kMore_m2 = 1.0;
/// Frontiers that the outcome names; a result holds no more words.
constexpr std::size_t kNamed = 1;
/// Of walls that were known before the order; robots have others.
constexpr int kNoStore = 0;
/// A map that has moved by so much under a robot on its way is a reason to plan it anew.
constexpr double kMoved_m = 0.15;
/// A robot that knows its place worse is told where it is, so well; it stands then, for so long at least.
constexpr double kVague_m = 0.3, kVague_rad = Radians(6), kPlaced_m = 0.05, kPlaced_rad = Radians(0.6);
constexpr double kStands = 0.01, kSettled_s = 1.0;

double SecondsOf(Time time) {
  return 1e-6 * static_cast<double>(ToUtime(time));
}

double NeededWidth(const ExploreMissionConfig& config, const Footprint& footprint) {
  return footprint.width_m + 2 * config.route.least_margin_m;
}

std::vector<Rectangle> ShapesOf(const GroundPlan& plan) {
  std::vector<Rectangle> shapes;
  for (const WallPlan& wall : plan.walls) shapes.push_back(wall.Shape());
  return shapes;
}

}  // namespace

void ExploreMissionConfig::Describe(Archive& a) {
  a.Number("speed_m_s", speed_m_s, {"m/s", 0.05, 1, "on the way"});
  a.Number("near_m", near_m, {"m", 0.05, 1, "distance to a goal at which it counts as reached"});
  a.Number("reconsider_s", reconsider_s, {"s", 0.5, 60, "so often the frontier ahead is looked at anew"});
  a.Number("stands_s", stands_s,
           {"s", 1, 600, "a robot that holds on its way for so long fails the mission"});
  a.Number("idle_s", idle_s, {"s", 1, 600, "a robot that comes no further for so long is blocked"});
  a.Number("thing_m", thing_m, {"m", 0.1, 3, "size that something in the way is taken to have"});
  a.Integer("rounds", rounds, {"-", 0, 20, "rounds over what was left that see nothing more"});
  a.Integer("retries", retries, {"-", 0, 20, "paths that end elsewhere before a frontier is given up"});
  limits.Describe(a);
  a.Section("route", route, "the way to a frontier");
  a.Section("choice", choice, "which frontier is next");
  a.Section("graph", graph, "the map that is made, and where the robot is in it");
}

ExploreMission::ExploreMission(const ExploreMissionConfig& config, const Footprint& footprint,
                               const GroundPlan& plan)
    : config_(config),
      footprint_(footprint),
      planner_(config.route, footprint, plan),
      exploration_(config.choice, NeededWidth(config, footprint), ShapesOf(plan)),
      graph_(config.graph) {}

std::optional<SeenFloor> ExploreMission::Seen() {
  if (!begun_) return std::nullopt;
  return SeenFloorOf(exploration_.grid(), config_.choice.least_frontier_m, exploration_.left());
}

std::optional<Refusal> ExploreMission::Start(const MissionOrder& /*order*/) {
  begun_ = true;
  planner_.Forget();
  exploration_.Reset();
  graph_.Reset();
  trail_.clear();
  outcome_.reset();
  placing_ = Placing::kNo;
  stands_.Reset();
  idles_.Reset();
  goal_.reset();
  considered_.reset();
  learned_ = false;
  missed_ = 0;
  rounds_ = 0;
  most_seen_m2_ = 0;
  backing_ = false;
  stopped_at_.reset();
  undecided_ = false;
  return std::nullopt;
}

void ExploreMission::set_config(const ExploreMissionConfig& config) {
  config_ = config;
  exploration_.set_config(config.choice);
}

void ExploreMission::Step(MissionControl& control) {
  Note(control);
  const Heard& heard = control.heard();
  if (!heard.link_up || !heard.pose || !IsFresh(*heard.pose, control.now())) return;
  if (outcome_ || IsVague(control)) return Place(control);
  if ((!goal_ && !backing_) || undecided_) return Next(control);
  const bool is_new = heard.pose->stamp > *control.path_sent();
  if (!is_new || !control.OnPath()) return;
  if (heard.drive->mode == DriveMode::kArrived) return Arrive(control);
  if (stands_.Stands_s(control) > config_.stands_s)
    return control.Fail(
        fmt::format("the robot has held on its way for {:.0f} s: {}; next: see where it is, priamos place",
                    config_.stands_s, heard.drive->limit));
  if (idles_.Stands_s(control) > config_.idle_s) {
    idles_.Reset();
    return OnStop(control, {Stop::Cause::kBlocked, "the robot came no further"});
  }
  if (goal_) Reconsider(control);
}

/// What the robot tells is in its own frame; the map is another one, in which everything else is done.
void ExploreMission::Note(MissionControl& control) {
  const Heard& heard = control.heard();
  if (!heard.pose) return;
  const bool begins = graph_.empty();
  graph_.NoteAt(heard.pose->map_from_base, SecondsOf(heard.pose->stamp));
  if (begins && heard.learned)  // told before the order
    for (const LearnedWall& wall : heard.learned->walls) graph_.NoteWall({kNoStore, wall.id, false, wall});
  for (const SeenWall& seen : heard.told) graph_.NoteWall(seen);
  if (!heard.told.empty() && graph_.Settle()) {
    std::vector<Pose2> trail;
    for (const GraphAnchor& anchor : trail_) trail.push_back(graph_.PlaceOf(anchor));
    exploration_.MoveTrail(trail);
    learned_ = false;
    Learn(BaseOf(control));
    control.SendMap(exploration_.walls());
  }
  const Pose2 base = BaseOf(control);
  if (exploration_.NoteAt(base)) trail_.push_back(graph_.AnchorOf(base));
}

Pose2 ExploreMission::BaseOf(const MissionControl& control) const {
  return graph_.map_from_robot() * control.heard().pose->map_from_base;
}

/// A path in the map, for a robot that drives in its own frame.
void ExploreMission::Order(MissionControl& control, PlannedPath path) {
  ordered_by_ = graph_.map_from_robot();
  const Pose2 robot_from_map = ordered_by_.Inverse();
  for (Pose2& point : path.points) point = robot_from_map * point;
  control.OrderPath(FirstPart(std::move(path)), config_.speed_m_s);
}

void ExploreMission::Learn(const Pose2& base) {
  if (std::exchange(learned_, true)) return;
  exploration_.Learn(graph_.Walls());
  planner_.Learn(SureParts(exploration_.walls()), base);
}

/// While the base drives: what it was to see may be seen by now, a wall may have turned up on its way, or the
/// map may have moved.
void ExploreMission::Reconsider(MissionControl& control) {
  if (considered_ && Seconds(control.now() - *considered_) < config_.reconsider_s) return;
  considered_ = control.now();
  const Pose2 base = BaseOf(control);
  Learn(base);
  auto left = PointsLeft(control.path().points, control.heard().drive->remaining_m);
  for (Pose2& point : left) point = graph_.map_from_robot() * point;
  const Pose2& told = control.heard().pose->map_from_base;
  const bool moved = ((ordered_by_ * told).translation() - base.translation()).norm() > kMoved_m;
  if (moved || !exploration_.IsOpen(*goal_) || !planner_.AreFree(base, left)) Next(control);
}

void ExploreMission::Arrive(MissionControl& control) {
  if (!goal_) return Next(control);
  const Pose2 base = BaseOf(control);
  const double off_m = (base.translation() - goal_->goal).norm();
  Learn(base);
  const bool open = exploration_.IsOpen(*goal_);
  if (open && off_m < config_.near_m)
    exploration_.GiveUp(goal_->target, "seen from near by, and nothing is known of it", true);
  else if (open && ++missed_ > config_.retries)
    exploration_.GiveUp(goal_->target, "the paths to it ended elsewhere");
  Next(control);
}

/// What stopped the base is closed from now on; a frontier that is no longer one by that is done with. A base
/// that is stopped twice at a place stands too near to something, and is not shut in by more things.
void ExploreMission::OnStop(MissionControl& control, const Stop& stop) {
  Note(control);
  if (outcome_) return control.Enter(Phase::kDone, *outcome_);
  placing_ = Placing::kNo;
  if (stop.cause != Stop::Cause::kBlocked || (!goal_ && !backing_))
    return control.Fail(stop.reason + "; next: look what it is, and order it again");
  const Eigen::Vector2d here = BaseOf(control).translation();
  const bool again = stopped_at_ && (here - *stopped_at_).norm() < kSamePlace_m;
  stopped_at_ = here;
  if (backing_) return Next(control);
  if (again) {
    exploration_.GiveUp(goal_->target, stop.reason);
    if (!GoBack(control)) Next(control);
    return;
  }
  if (auto thing = ThingAhead(control, footprint_, config_.thing_m)) {
    thing->map_from_centre = graph_.map_from_robot() * thing->map_from_centre;
    exploration_.AddThing(*thing);
  }
  if (++missed_ > config_.retries) exploration_.GiveUp(goal_->target, stop.reason);
  Next(control);
}

void ExploreMission::Next(MissionControl& control) {
  const Pose2 base = BaseOf(control);
  learned_ = false;  // it may have driven through what was a wall
  Learn(base);
  considered_ = control.now();
  undecided_ = false;
  backing_ = false;
  for (int i = 0; i < kMostTries; ++i) {
    const auto frontier = exploration_.Choose(base);
    if (!frontier && !BeginRound()) return Finish(control);
    const bool shut_in = stopped_at_ && (base.translation() - *stopped_at_).norm() < kShutIn_m;
    if (!frontier && shut_in && GoBack(control)) return;
    if (!frontier) continue;
    if (DriveTo(control, *frontier)) return;
    exploration_.GiveUp(frontier->target, WhyNoWay(base, *frontier));
  }
  undecided_ = true;  // the rest is looked at in the next time step
  if (!control.path_sent() || !control.path().points.empty()) control.OrderPath({}, 0);
}

/// What was left is tried again. It ends: what can be seen is limited, and so are the rounds that see no
/// more.
bool ExploreMission::BeginRound() {
  const double seen_m2 = exploration_.grid().free_m2();
  if (seen_m2 > most_seen_m2_ + kMore_m2) {
    most_seen_m2_ = seen_m2;
    rounds_ = 0;
  }
  return ++rounds_ <= config_.rounds && exploration_.TryAgain();
}

/// A bit of the way that it came, to where there is room around it. False where it began.
bool ExploreMission::GoBack(MissionControl& control) {
  PlannedPath way{.points = exploration_.WayBack(kBack_m)};
  if (way.points.empty()) return false;
  goal_.reset();
  backing_ = true;
  idles_.Reset();
  Order(control, std::move(way));
  control.Enter(Phase::kDriving, "exploring: something is near on all sides, going back a bit");
  return true;
}

std::string ExploreMission::WhyNoWay(const Pose2& base, const FrontierGoal& frontier) const {
  const auto refusal =
      planner_.CheckEnds(base, {{frontier.target.x(), frontier.target.y(), base.yaw}, false});
  return refusal ? refusal->reason : "no way for the whole base leads there";
}

/// False when no way leads there.
bool ExploreMission::DriveTo(MissionControl& control, const FrontierGoal& frontier) {
  const Pose2 base = BaseOf(control);
  planner_.Take(exploration_.ObstaclesFor(frontier), base);
  auto path = planner_.FindPath(base, {{frontier.goal.x(), frontier.goal.y(), base.yaw}, false});
  if (!path && frontier.goal != frontier.target)
    path = planner_.FindPath(base, {{frontier.target.x(), frontier.target.y(), base.yaw}, false});
  if (!path) return false;
  path = FirstPart(std::move(*path));
  if (!goal_ || (goal_->target - frontier.target).norm() > config_.near_m) missed_ = 0;
  goal_ = frontier;
  const double length_m = LengthOf(base, path->points);
  Order(control, std::move(*path));
  control.Enter(Phase::kDriving, fmt::format("exploring, {:.0f} m2 seen; to ({:.1f}, {:.1f}), {:.1f} m",
                                             exploration_.grid().free_m2(), frontier.target.x(),
                                             frontier.target.y(), length_m));
  return true;
}

std::string ExploreMission::Left() const {
  const auto& left = exploration_.left();
  if (left.empty()) return "";
  std::string text = fmt::format("; {} frontiers left", left.size());
  for (std::size_t i = 0; i < std::min(kNamed, left.size()); ++i)
    text += fmt::format(", ({:.1f}, {:.1f}): {}", left[i].middle.x(), left[i].middle.y(), left[i].reason);
  return text;
}

void ExploreMission::Finish(MissionControl& control) {
  outcome_ = fmt::format("explored {:.0f} m2 in {:.0f} s, {:.0f} m driven{}", exploration_.grid().free_m2(),
                         Seconds(control.now() - control.started()), exploration_.driven_m(), Left());
  control.SendMap(exploration_.walls());
  placing_ = Placing::kNo;
  Place(control);
}

/// A robot holds when it does not know where it is in its own frame. Where it is on the map is known better,
/// and its own frame is what it says: so it is told that it is there, before it holds.
bool ExploreMission::IsVague(const MissionControl& control) const {
  const Eigen::Matrix3d& covariance = control.heard().pose->covariance;
  return placing_ != Placing::kNo || covariance(0, 0) + covariance(1, 1) > kVague_m * kVague_m ||
         covariance(2, 2) > kVague_rad * kVague_rad;
}

/// It has to stand before it can be told. In the end it is told where it is on the map: from then on its pose
/// is that of the map.
void ExploreMission::Place(MissionControl& control) {
  const RobotPose& pose = *control.heard().pose;
  if (placing_ == Placing::kNo) {
    placing_ = Placing::kBrakes;
    braked_ = control.now();
    return control.OrderPath({}, 0);
  }
  if (placing_ == Placing::kBrakes) {
    const bool stands = std::hypot(pose.velocity.vx, pose.velocity.vy, pose.velocity.wz) < kStands;
    if (!stands || Seconds(pose.stamp - braked_) < kSettled_s) return;
    placing_ = Placing::kTold;
    return control.OrderPlace(outcome_ ? BaseOf(control) : pose.map_from_base, kPlaced_m, kPlaced_rad);
  }
  if (control.IsPlacing()) return;
  placing_ = Placing::kNo;
  if (outcome_) return control.Enter(Phase::kDone, *outcome_);
  Next(control);
}

}  // namespace priamos::planner
