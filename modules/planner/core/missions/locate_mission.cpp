#include "planner/core/missions/locate_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/principal_axes.hpp"
#include "planner/core/map/map_landmarks.hpp"

namespace priamos::planner {
namespace {

/// The frame of the way is exact where it begins.
constexpr double kFrame_m = 0.02, kFrame_rad = 0.01;
/// What the robot is told when nobody knows where it is: it then drives no path.
constexpr double kUnknown_m = 2, kUnknown_rad = 1.6;
/// Sightings that confirm a place.
constexpr int kGoodLooks = 2;
/// A place that walls tell is not told better than the plan has them.
constexpr double kLeast_m = 0.12, kLeast_rad = 0.035;
/// Walls count again for what was driven without any.
constexpr double kSearchAgain_m = 1;

std::string Text(const Pose2& pose) {
  return fmt::format("({:.1f}, {:.1f}) {:.0f} deg", pose.x, pose.y, Degrees(pose.yaw));
}

}  // namespace

void LocateMissionConfig::Describe(Archive& a) {
  a.Number("speed_m_s", speed_m_s, {"m/s", 0.05, 1, "on the way"});
  a.Number("leeway_m", leeway_m, {"m", 0, 2, "how far a leg may be left around things"});
  a.Number("most_m", most_m, {"m", 2, 500, "driven in search of walls"});
  a.Integer("most_legs", most_legs, {"-", 2, 200, "legs driven in search of walls"});
  a.Integer("same_legs", same_legs, {"-", 1, 20, "legs without fewer candidates that end the search"});
  a.Number("same_m", same_m, {"m", 1, 100, "driven at least before that ends it"});
  a.Number("settle_s", settle_s, {"s", 1, 60, "the robot stands until the radio has brought what it heard"});
  a.Integer("most_tests", most_tests, {"-", 0, 20, "candidates that are looked at"});
  a.Number("alone_margin", alone_margin, {"-", 1, 100, "margin at which walls alone are believed"});
  a.Integer("alone_walls", alone_walls, {"-", 2, 50, "number of walls for that"});
  a.Number("drift_m", drift_m, {"m", 0.1, 0.45, "sigma at which the frame of the way begins anew"});
  limits.Describe(a);
  a.Section("search", search, "which places explain what was heard");
  a.Section("legs", legs, "where to drive without a map");
  a.Section("looks", looks, "looks at the door that decides");
}

LocateMission::LocateMission(const LocateMissionConfig& config, const RoutePlannerConfig& route,
                             const Footprint& footprint, const GroundPlan& plan)
    : config_(config), places_(plan), plan_(plan), views_(route, footprint, plan), looks_(config.looks) {}

std::optional<Refusal> LocateMission::Start(const MissionOrder&) {
  stage_ = Stage::kFraming;
  searched_ = count_before_ = test_ = 0;
  searched_at_m_ = 0;
  found_.clear();
  hypotheses_.clear();
  closed_.clear();
  legs_ = same_legs_ = 0;
  stands_since_ = changed_ = {};
  outcome_.clear();
  framed_ = false;
  if (places_.faces().empty()) return Refusal{"the plan has no walls: nothing tells its places apart"};
  return std::nullopt;
}

void LocateMission::Step(MissionControl& control) {
  const Heard& heard = control.heard();
  if (control.state().phase == Phase::kWaiting) {
    if (!heard.link_up || !heard.pose || !IsFresh(*heard.pose, control.now())) return;
    log_.Begin(control.now());
    return Frame(control);
  }
  Listen(control);
  switch (stage_) {
    case Stage::kFraming:
      if (control.place_refused())
        return control.Fail("the robot does not take a pose: is it driven by hand?");
      if (IsPlaced(control) && !log_.empty()) NextLeg(control);
      return;
    case Stage::kLeg:
      if (HasArrived(control)) EndLeg(control);
      return;
    case Stage::kSettling:
      if (HasSettled(control)) Decide(control);
      return;
    case Stage::kPlacing:
      if (control.place_refused()) return GiveUp(control, "the robot does not take the place that was found");
      if (IsPlaced(control)) Approach(control);
      return;
    case Stage::kApproaching:
      if (!HasArrived(control)) return;
      stage_ = Stage::kLooking;
      return;
    case Stage::kLooking:
      return Look(control);
    case Stage::kGivingBack:
      if (!control.IsPlacing()) control.Enter(Phase::kFailed, outcome_);
      return;
  }
}

void LocateMission::Listen(const MissionControl& control) {
  const Heard& heard = control.heard();
  if (control.IsPlacing() && stage_ == Stage::kFraming && log_.empty()) return;
  log_.OnPose(heard.pose->stamp, heard.pose->map_from_base, heard.corrected);
  const std::size_t before = log_.revision();
  for (const SeenWall& wall : heard.told) log_.OnWall(wall);
  if (log_.revision() != before) changed_ = control.now();
}

/// Weighs all places of the plan anew, when something new was heard.
void LocateMission::Search() {
  const bool same = searched_ == log_.revision() && log_.driven_m() < searched_at_m_ + kSearchAgain_m;
  if (same || log_.empty()) return;
  searched_ = log_.revision();
  searched_at_m_ = log_.driven_m();
  found_ = FindPlaces(config_.search, places_, log_.way());
}

/// The robot's pose is wrong, and how well it believes to know it says nothing of the way from here. So the
/// way has a frame of its own, which begins here and is exact.
void LocateMission::Frame(MissionControl& control) {
  stage_ = Stage::kFraming;
  framed_ = true;
  control.OrderPlace(control.heard().pose->map_from_base, kFrame_m, kFrame_rad);
  Tell(control, "begins");
}

bool LocateMission::HasArrived(const MissionControl& control) const {
  const Heard& heard = control.heard();
  return heard.pose->stamp > *control.path_sent() && control.OnPath() &&
         heard.drive->mode == DriveMode::kArrived;
}

/// Whether the robot has obeyed, and has sent a pose since.
bool LocateMission::IsPlaced(const MissionControl& control) const {
  const Heard& heard = control.heard();
  return !control.IsPlacing() && heard.corrected && heard.pose->stamp > *heard.corrected;
}

void LocateMission::NextLeg(MissionControl& control) {
  const bool far = log_.driven_m() > config_.most_m || legs_ >= config_.most_legs;
  const auto leg = far ? std::nullopt : ChooseLeg(config_.legs, log_.way(), closed_);
  if (!leg) {
    stage_ = Stage::kSettling;
    return;
  }
  if (PositionSigma(control.heard().pose->covariance) > config_.drift_m) return Frame(control);
  stage_ = Stage::kLeg;
  ++legs_;
  leg_towards_ = (leg->translation() - log_.way_from_base().translation()).normalized();
  PlannedPath path;
  path.points = {log_.way_from_told().Inverse() * *leg};
  path.leeway = {{config_.leeway_m, config_.leeway_m}};
  control.OrderPath(std::move(path), config_.speed_m_s);
  Tell(control, fmt::format("leg {}", legs_));
}

void LocateMission::EndLeg(MissionControl& control) {
  stands_since_ = control.now();
  Search();
  // What is known already once the robot stands may save the next leg.
  const bool one = found_.size() == 1 && found_.front().IsPoint();
  same_legs_ = !found_.empty() && found_.size() == count_before_ ? same_legs_ + 1 : 0;
  count_before_ = found_.size();
  const bool few = !found_.empty() && found_.size() <= std::size_t(config_.most_tests) &&
                   std::all_of(found_.begin(), found_.end(), [](const auto& c) { return c.IsHeld(); });
  const bool stays = few && same_legs_ >= config_.same_legs && log_.driven_m() >= config_.same_m;
  if (!one && !stays) return NextLeg(control);
  stage_ = Stage::kSettling;
}

/// Standing, until the radio has brought all that is new.
bool LocateMission::HasSettled(const MissionControl& control) const {
  return Seconds(control.now() - std::max(changed_, stands_since_)) > config_.settle_s;
}

void LocateMission::Decide(MissionControl& control) {
  Search();
  const bool points =
      !found_.empty() && std::all_of(found_.begin(), found_.end(), [](const auto& c) { return c.IsHeld(); });
  if (points && found_.size() <= std::size_t(config_.most_tests)) return BeginTests(control);
  // What came while the robot stood may show another leg.
  if (log_.driven_m() <= config_.most_m && legs_ < config_.most_legs &&
      ChooseLeg(config_.legs, log_.way(), closed_))
    return NextLeg(control);
  if (found_.empty()) return GiveUp(control, "no place on the plan explains what was heard");
  hypotheses_.clear();
  for (const PlaceCandidate& c : found_)
    hypotheses_.push_back({c.map_from_base * log_.way_from_base().Inverse(), 0.2, 0.05, c.score, c.matched});
  GiveUp(control, Candidates());
}

void LocateMission::BeginTests(MissionControl& control) {
  hypotheses_.clear();
  for (const PlaceCandidate& c : found_)
    hypotheses_.push_back({c.map_from_base * log_.way_from_base().Inverse(),
                           std::max(kLeast_m, PositionSigma(c.covariance)),
                           std::max(kLeast_rad, std::sqrt(c.covariance(2, 2))), c.score, c.matched});
  test_ = 0;
  seen_doors_.clear();
  NextTest(control);
}

std::vector<Pose2> LocateMission::Others() const {
  std::vector<Pose2> others;
  for (std::size_t i = 0; i < hypotheses_.size(); ++i)
    if (i != test_) others.push_back(PlaceOf(hypotheses_[i]));
  return others;
}

/// Has the robot believe in the next candidate that a door can tell from the others.
void LocateMission::NextTest(MissionControl& control) {
  for (; test_ < hypotheses_.size(); ++test_, seen_doors_.clear()) {
    const Pose2 place = PlaceOf(hypotheses_[test_]);
    view_ = views_.Nearest(place, Others(), seen_doors_);
    if (!view_) continue;
    stage_ = Stage::kPlacing;
    control.OrderPlace(place, hypotheses_[test_].sigma_m, hypotheses_[test_].sigma_yaw_rad);
    return Tell(control, fmt::format("looks for door '{}' as from {}", view_->door.name, Text(place)));
  }
  if (hypotheses_.size() == 1) return BelieveWalls(control);
  GiveUp(control, Candidates());
}

/// The way is planned anew: it begins where the robot is by now.
void LocateMission::Approach(MissionControl& control) {
  const Pose2& base = control.heard().pose->map_from_base;
  view_ = views_.Nearest(base, Others(), seen_doors_);
  if (!view_) {
    Tell(control, "no other door tells");
    ++test_;
    seen_doors_.clear();
    return NextTest(control);
  }
  looks_.Reset();
  n_good_ = 0;
  control.SendModel(*MakeLandmark(plan_, view_->door.id));
  stage_ = Stage::kApproaching;
  if (view_->path.points.size() > kMostPathPoints) {
    view_->path.points.resize(kMostPathPoints);
    view_->path.leeway.resize(kMostPathPoints);
  }
  control.OrderPath(view_->path, config_.speed_m_s);
}

void LocateMission::Look(MissionControl& control) {
  for (const LookResult& result : control.heard().looks) looks_.OnResult(result);
  const auto result = looks_.Settle(control.now());
  if (result && result->ok) ++n_good_;
  if (result && result->no_model) control.SendModel(*MakeLandmark(plan_, view_->door.id));
  if (n_good_ >= kGoodLooks) return Confirm(control);
  if (looks_.Exhausted()) {
    Tell(control, fmt::format("door '{}' not seen: {}", view_->door.name, looks_.trouble()));
    seen_doors_.push_back(view_->door.id);
    return Approach(control);
  }
  if (looks_.Ready(control.now()))
    looks_.Asked(control.OrderLook(view_->door.id, looks_.next()), control.now());
}

/// The door was seen. It is believed unless the walls, those heard on the way to it included, have found
/// another place meanwhile.
void LocateMission::Confirm(MissionControl& control) {
  constexpr double kFits_m = 0.6, kFits_rad = 0.2;
  Search();
  const Pose2 place = PlaceOf(hypotheses_[test_]);
  const bool fits = std::any_of(found_.begin(), found_.end(), [&](const PlaceCandidate& c) {
    return (c.map_from_base.translation() - place.translation()).norm() < kFits_m &&
           std::abs(WrapAngle(c.map_from_base.yaw - place.yaw)) < kFits_rad;
  });
  if (fits) return Believe(control, fmt::format("door '{}' seen", view_->door.name));
  ++test_;
  seen_doors_.clear();
  NextTest(control);
}

void LocateMission::BelieveWalls(MissionControl& control) {
  PlaceSearchConfig strict = config_.search;
  strict.margin = config_.alone_margin;
  const auto found = FindPlaces(strict, places_, log_.way());
  const bool sure =
      found.size() == 1 && found.front().IsPoint() && found.front().matched >= config_.alone_walls;
  if (!sure)
    return GiveUp(control,
                  fmt::format("unconfirmed: {}, no door in sight tells", Text(PlaceOf(hypotheses_[0]))));
  test_ = 0;
  hypotheses_[0].map_from_way = found.front().map_from_base * log_.way_from_base().Inverse();
  control.OrderPlace(PlaceOf(hypotheses_[0]), hypotheses_[0].sigma_m, hypotheses_[0].sigma_yaw_rad);
  framed_ = false;
  control.Enter(Phase::kDone,
                fmt::format("at {}, by {} walls alone, {:.1f} m driven", Text(PlaceOf(hypotheses_[0])),
                            found.front().matched, log_.driven_m()));
}

void LocateMission::Believe(MissionControl& control, const std::string& because) {
  framed_ = false;
  const RobotPose& pose = *control.heard().pose;
  control.Enter(Phase::kDone, fmt::format("at {}, known to {:.2f} m: {}, {} walls, {:.1f} m driven",
                                          Text(pose.map_from_base), PositionSigma(pose.covariance), because,
                                          hypotheses_[test_].matched, log_.driven_m()));
}

/// Ends the mission without a place; first the robot is told that nobody knows where it is.
void LocateMission::GiveUp(MissionControl& control, std::string reason) {
  outcome_ = std::move(reason);
  stage_ = Stage::kGivingBack;
  GiveBack(control);
  Tell(control, outcome_);
}

void LocateMission::GiveBack(MissionControl& control) {
  if (!std::exchange(framed_, false)) return;
  control.OrderPlace(log_.empty() ? control.heard().pose->map_from_base : log_.way_from_base(), kUnknown_m,
                     kUnknown_rad);
}

void LocateMission::OnEnded(MissionControl& control) {
  GiveBack(control);
}

void LocateMission::OnStop(MissionControl& control, const Stop& stop) {
  if (stop.cause != Stop::Cause::kBlocked) {
    control.Fail(stop.reason);
    return GiveBack(control);
  }
  if (stage_ == Stage::kLeg) {
    closed_.push_back({log_.way_from_base().translation(), leg_towards_});
    control.OrderPath({}, 0);
    return EndLeg(control);
  }
  if (stage_ != Stage::kApproaching) return;
  seen_doors_.push_back(view_->door.id);
  control.OrderPath({}, 0);
  Approach(control);
}

std::string LocateMission::Unfinished() const {
  return hypotheses_.empty() ? "not found where it is" : Candidates();
}

std::string LocateMission::Candidates() const {
  constexpr std::size_t kShown = 3;
  std::string text = fmt::format("ambiguous: {} places:", hypotheses_.size());
  for (std::size_t i = 0; i < std::min(kShown, hypotheses_.size()); ++i)
    text += (i > 0 ? "; " : " ") + Text(PlaceOf(hypotheses_[i]));
  return text + (hypotheses_.size() > kShown ? "; ..." : "");
}

void LocateMission::Tell(MissionControl& control, const std::string& what) const {
  control.Enter(Phase::kDriving,
                fmt::format("finding out where it is: {} ({} walls heard, {:.1f} m driven, {} places)", what,
                            log_.empty() ? 0 : log_.way().pieces.size(), log_.driven_m(), found_.size()));
}

}  // namespace priamos::planner
