#include "planner/core/missions/explore_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace priamos::planner {
namespace {

/// Frontiers to which a way is looked for in one time step.
constexpr int kMostTries = 5;
/// What stopped the base stands so near that it must not turn there: it goes back so far first.
constexpr double kRetreat_m = 0.5;
/// A base that is stopped so near to where it was stopped before is shut in, and goes back farther; in the
/// end also one that stands so near to it.
constexpr double kSamePlace_m = 0.3, kBack_m = 1.5, kShutIn_m = 1.0;
/// A base that is stopped so near to its border was stopped by what is there: so often again at one place
/// before the border is given up; one that is farther away only after more stops.
constexpr double kAtTarget_m = 2.5;
constexpr int kMostStopsAtTarget = 1, kMostStopsHere = 3;
/// Who comes no farther has stayed where it was, or, with frontiers left, in a place that is closed all
/// around.
constexpr double kMovesAtLeast_m = 0.3, kLeavesAtLeast_m = 1.5;
/// A round that saw no more than so much more has seen nothing.
constexpr double kMore_m2 = 1.0;
/// Frontiers that the outcome names; a result holds no more words.
constexpr std::size_t kNamed = 1;
/// Of walls and points that were known before the order; robots have others.
constexpr int kWallStore = 0, kPointStore = -1;
/// A map that has moved by so much under a robot on its way is a reason to plan it anew.
constexpr double kMoved_m = 0.15;

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

ExploreMission::ExploreMission(const ExploreMissionConfig& config, const Footprint& footprint,
                               const GroundPlan& plan)
    : config_(config),
      footprint_(footprint),
      planner_(config.route, footprint, plan),
      exploration_(config.choice, NeededWidth(config, footprint), ShapesOf(plan)),
      drawn_(plan),
      doors_(plan.doors),
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
  objects_.Reset();
  heard_.reset();
  saw_ = false;
  trail_.clear();
  outcome_.reset();
  placing_ = Placing::kNo;
  progress_.Reset();
  goal_.reset();
  tried_.reset();
  considered_.reset();
  learned_ = false;
  missed_ = 0;
  rounds_ = 0;
  most_seen_m2_ = 0;
  backing_ = false;
  stopped_at_.reset();
  stopped_by_.reset();
  in_the_way_.clear();
  stops_here_ = 0;
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
  if (const auto stop = progress_.Step(control, config_.stands_s, config_.idle_s))
    return OnStop(control, *stop);
  if (!control.running()) return;
  if (!goal_) return;
  NoteAhead(control);
  Reconsider(control);
}

/// What the robot tells is in its own frame; the map is another one, in which everything else is done.
void ExploreMission::Note(MissionControl& control) {
  const Heard& heard = control.heard();
  if (!heard.pose) return;
  const bool begins = graph_.empty();
  graph_.NoteAt(heard.pose->map_from_base, SecondsOf(heard.pose->stamp));
  if (begins && heard.learned) NoteKnown(*heard.learned);
  NoteObjects(control);
  for (const SeenFeature& seen : heard.told) graph_.Note(seen);
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

/// What was told before the order.
void ExploreMission::NoteKnown(const LearnedWalls& known) {
  for (const LearnedWall& wall : known.walls) graph_.Note({kWallStore, wall.id, wall});
  for (const LearnedPoint& point : known.points) graph_.Note({kPointStore, point.id, point});
}

void ExploreMission::NoteObjects(const MissionControl& control) {
  const auto& learned = control.heard().learned;
  if (!learned || learned == heard_) return;
  heard_ = learned;
  if (!objects_.Take(learned->objects, graph_)) return;
  learned_ = false;
  saw_ = true;
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
  LearnedWalls seen;
  seen.objects = objects_.At(graph_);
  if (heard_) seen.doors = heard_->doors;
  exploration_.Learn(graph_.Walls(), ObstaclesOf(seen, drawn_, doors_));
  planner_.Learn(exploration_.WallsForWays(), base);
}

void ExploreMission::KeepOff(const FrontierGoal& goal, const Pose2& base) {
  planner_.Take(exploration_.ThingsForWays(), base, exploration_.UnknownFor(goal));
}

/// Returns whether there is one more on the map.
bool ExploreMission::NoteThing(const MissionControl& control) {
  auto thing = ThingAhead(control, footprint_, config_.thing_m);
  if (!thing) return false;
  thing->map_from_centre = graph_.map_from_robot() * thing->map_from_centre;
  return exploration_.AddThing(*thing);
}

/// Who hears something ahead does not drive up to it: there it could not even turn.
void ExploreMission::NoteAhead(const MissionControl& control) {
  const auto& nearest = control.heard().drive->nearest;
  if (!nearest || nearest->free_m > config_.meets_m) return;
  const Pose2 base = BaseOf(control);
  if (exploration_.Knows(base * nearest->at, base.translation())) return;
  if (!NoteThing(control)) return;
  KeepOff(*goal_, base);
  considered_.reset();
}

/// While the base drives: what it was to see may be seen by now, a wall may have turned up on its way, or the
/// map may have moved.
void ExploreMission::Reconsider(MissionControl& control) {
  if (considered_ && Seconds(control.now() - *considered_) < config_.reconsider_s) return;
  considered_ = control.now();
  const Pose2 base = BaseOf(control);
  Learn(base);
  if (std::exchange(saw_, false)) KeepOff(*goal_, base);
  auto left = PointsLeft(control.path().points, control.heard().drive->remaining_m);
  for (Pose2& point : left) point = graph_.map_from_robot() * point;
  const Pose2& told = control.heard().pose->map_from_base;
  const bool moved = ((ordered_by_ * told).translation() - base.translation()).norm() > kMoved_m;
  in_the_way_ = planner_.InTheWay(base, left);
  if (moved || !exploration_.IsOpen(*goal_) || !in_the_way_.empty()) Next(control);
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
/// that is stopped several times at a place stands too near to something, and goes back farther.
void ExploreMission::OnStop(MissionControl& control, const Stop& stop) {
  Note(control);
  if (outcome_) return End(control);
  placing_ = Placing::kNo;
  if (stop.cause != Stop::Cause::kBlocked || (!goal_ && !backing_))
    return control.Fail(stop.reason + "; next: look what it is, and order it again");
  NoteStop(control);
  if (backing_) return Next(control);
  NoteThing(control);
  // What is in the way here says nothing of a border that is far away.
  const bool at_target = (goal_->target - *stopped_at_).norm() < kAtTarget_m;
  const int most = at_target ? kMostStopsAtTarget : kMostStopsHere;
  if (++missed_ > config_.retries || stops_here_ > most || (at_target && exploration_.again()))
    exploration_.GiveUp(goal_->target, stop.reason);
  if (!GoBack(control, kRetreat_m * (1 + stops_here_))) Next(control);
}

void ExploreMission::NoteStop(const MissionControl& control) {
  const Pose2 base = BaseOf(control);
  const bool again = stopped_at_ && (base.translation() - *stopped_at_).norm() < kSamePlace_m;
  stops_here_ = again ? stops_here_ + 1 : 0;
  stopped_at_ = base.translation();
  stopped_by_.reset();
  if (const auto& nearest = control.heard().drive->nearest) stopped_by_ = base * nearest->at;
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
    if (!frontier && shut_in && GoBack(control, kBack_m)) return;
    if (!frontier) continue;
    auto path = WayTo(base, *frontier);
    if (path) return DriveTo(control, *frontier, std::move(*path));
    if (i == 0 && IsShutIn(base) && GoBack(control, kBack_m)) return;
    exploration_.GiveUp(frontier->target, path.reason());
  }
  undecided_ = true;  // the rest is looked at in the next time step
  if (!control.path_sent() || !control.path().points.empty()) control.OrderPath({}, 0);
}

/// Whether no way leads to where it was a while ago: then that none leads to a border says nothing of the
/// border.
bool ExploreMission::IsShutIn(const Pose2& base) const {
  const auto back = exploration_.WayBack(kBack_m);
  return !back.empty() && !planner_.FindPath(base, {back.back(), false});
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

/// A bit of its own way, to where there is room around it, and away from what stopped it: it was there with
/// its whole body. False where it began.
bool ExploreMission::GoBack(MissionControl& control, double length_m) {
  const Eigen::Vector2d here = BaseOf(control).translation();
  const Eigen::Vector2d towards = stopped_by_.value_or(here) - here;
  const auto leads = [&](const std::vector<Pose2>& way) {
    return way.empty() ? std::numeric_limits<double>::infinity()
                       : towards.dot(way.back().translation() - here);
  };
  PlannedPath way{.points = exploration_.WayBack(length_m)};
  if (auto on = exploration_.WayOn(length_m); leads(on) < leads(way.points)) way.points = std::move(on);
  if (way.points.empty()) return false;
  way.leeway = planner_.LeewayInPassages(BaseOf(control), way.points, {kLeastLeeway_m, kLeastLeeway_m});
  goal_.reset();
  backing_ = true;
  progress_.ResetIdle();
  Order(control, std::move(way));
  control.Enter(Phase::kDriving, fmt::format("exploring: {} is near, going back a bit",
                                             in_the_way_.empty() ? "something" : in_the_way_));
  in_the_way_.clear();
  return true;
}

/// A way for the whole base to the place beyond the frontier, or at least to the frontier, that is worth it.
Outcome<PlannedPath> ExploreMission::WayTo(const Pose2& base, const FrontierGoal& frontier) {
  KeepOff(frontier, base);
  std::optional<double> too_far_m;
  const Pose2 at{frontier.target.x(), frontier.target.y(), base.yaw};
  for (const Pose2& to : {Pose2{frontier.goal.x(), frontier.goal.y(), base.yaw}, at}) {
    if (auto path = planner_.FindPath(base, {to, false})) {
      const double length_m = LengthOf(base, path->points);
      if (exploration_.IsWorth(frontier, length_m)) return *path;
      too_far_m = length_m;
    }
    if (frontier.goal == frontier.target) break;
  }
  if (too_far_m)
    return Refusal{
        fmt::format("the way there is {:.0f} m, for {:.1f} m2 at most", *too_far_m, frontier.gain_m2)};
  return planner_.CheckEnds(base, {at, false}).value_or(Refusal{"no way for the whole base leads there"});
}

void ExploreMission::DriveTo(MissionControl& control, const FrontierGoal& frontier, PlannedPath path) {
  if (!tried_ || (*tried_ - frontier.target).norm() > config_.near_m) missed_ = 0;
  tried_ = frontier.target;
  goal_ = frontier;
  path = FirstPart(std::move(path));
  const double length_m = LengthOf(BaseOf(control), path.points);
  Order(control, std::move(path));
  control.Enter(Phase::kDriving, fmt::format("exploring, {:.0f} m2 seen; to ({:.1f}, {:.1f}), {:.1f} m",
                                             exploration_.grid().free_m2(), frontier.target.x(),
                                             frontier.target.y(), length_m));
}

std::string ExploreMission::Left() const {
  const auto& left = exploration_.left();
  if (left.empty()) return "";
  std::string text = fmt::format("; {} frontiers left", left.size());
  for (std::size_t i = 0; i < std::min(kNamed, left.size()); ++i)
    text += fmt::format(", ({:.1f}, {:.1f}): {}", left[i].middle.x(), left[i].middle.y(), left[i].reason);
  return text;
}

/// Why what was seen is no exploration; empty: it is one.
std::string ExploreMission::WhyNothing() const {
  const double reached_m = exploration_.reached_m();
  if (reached_m < kMovesAtLeast_m) return "the base has not moved";
  if (exploration_.left().empty()) return "";
  return reached_m < kLeavesAtLeast_m ? "the base has not left where it began" : "";
}

void ExploreMission::Finish(MissionControl& control) {
  const std::string nothing = WhyNothing();
  const std::string seen =
      fmt::format("explored {:.0f} m2 in {:.0f} s, {:.0f} m driven{}", exploration_.grid().free_m2(),
                  Seconds(control.now() - control.started()), exploration_.driven_m(), Left());
  if (nothing.empty())
    outcome_ = {Phase::kDone, seen};
  else
    outcome_ = {Phase::kFailed,
                fmt::format("{}: nothing more is reached; next: see what is around it, priamos map reset; {}",
                            nothing, seen)};
  LearnedWalls made = exploration_.walls();
  made.objects = objects_.At(graph_);  // where the robot is told to be on the map, too
  control.SendMap(std::move(made));
  placing_ = Placing::kNo;
  Place(control);
}

void ExploreMission::End(MissionControl& control) {
  if (outcome_->phase == Phase::kFailed) return control.Fail(outcome_->text);
  control.Enter(outcome_->phase, outcome_->text);
}

}  // namespace priamos::planner
