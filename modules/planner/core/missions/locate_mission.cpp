#include "planner/core/missions/locate_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/principal_axes.hpp"

namespace priamos::planner {
namespace {

/// The frame of the way is exact where it begins.
constexpr double kFrame_m = 0.02, kFrame_rad = 0.01;
/// What the robot is told when nobody knows where it is: it then drives no path.
constexpr double kUnknown_m = 2, kUnknown_rad = 1.6;

std::string CandidateText(const Pose2& pose) {
  return fmt::format("({:.1f}, {:.1f}) {:.0f} deg", pose.x, pose.y, Degrees(pose.yaw));
}

}  // namespace

void LocateMissionConfig::Describe(Archive& a) {
  a.Number("settle_s", settle_s, {"s", 1, 60, "the robot stands until the radio has brought what it heard"});
  a.Integer("most_tests", most_tests, {"-", 0, 50, "candidates that are looked at"});
  a.Integer("rounds", rounds, {"-", 1, 20, "so often they are looked at, with more legs between"});
  a.Number("alone_margin", alone_margin, {"-", 1, 100, "margin at which walls alone are believed"});
  a.Integer("alone_walls", alone_walls, {"-", 2, 50, "number of walls for that"});
  a.Number("stands_s", stands_s, {"s", 1, 60, "a robot that comes no farther for so long is blocked"});
  a.Number("thing_m", thing_m, {"m", 0.1, 3, "size that something in the way is taken to have"});
  a.Number("drift_m", drift_m, {"m", 0.1, 0.45, "sigma at which the frame of the way begins anew"});
  limits.Describe(a);
  a.Section("search", search, "which places explain what was heard");
  a.Section("legs", legs, "driving without a map");
  a.Section("looks", looks, "looks at the doors that decide");
}

LocateMission::LocateMission(const LocateMissionConfig& config, const RoutePlannerConfig& route,
                             const Footprint& footprint, const GroundPlan& plan)
    : config_(config),
      footprint_(footprint),
      evidence_(config.search, plan),
      legs_(config.legs),
      looks_(config.looks, route, footprint, plan) {}

std::optional<Refusal> LocateMission::Start(const MissionOrder&) {
  stage_ = Stage::kFraming;
  round_ = 0;
  evidence_.Begin({});
  legs_.Reset();
  looks_.Reset();
  stands_since_ = {};
  outcome_.clear();
  framed_ = false;
  if (evidence_.plan().faces().empty())
    return Refusal{"the plan has no walls: nothing tells its places apart"};
  return std::nullopt;
}

void LocateMission::Step(MissionControl& control) {
  const Heard& heard = control.heard();
  if (control.state().phase == Phase::kWaiting) {
    if (!heard.link_up || !heard.pose || !IsFresh(*heard.pose, control.now())) return;
    evidence_.Begin(control.now());
    return Frame(control);
  }
  Listen(control);
  if (ComesNoFarther(control)) return OnStop(control, {Stop::Cause::kBlocked, "the robot came no farther"});
  switch (stage_) {
    case Stage::kFraming:
      if (control.place_refused())
        return control.Fail("the robot does not take a pose: is it driven by hand?");
      if (IsPlaced(control) && !evidence_.log().empty()) NextLeg(control);
      return;
    case Stage::kLegs:
      if (HasArrived(control)) EndLeg(control);
      return;
    case Stage::kSettling:
      if (HasSettled(control)) Decide(control);
      return;
    case Stage::kLooks:
      return Follow(control, looks_.Step(control, evidence_));
    case Stage::kGivingBack:
      if (!control.IsPlacing()) control.Enter(Phase::kFailed, outcome_);
      return;
  }
}

/// On its path, beside something that it can neither pass nor is stopped by.
bool LocateMission::ComesNoFarther(const MissionControl& control) {
  const bool drives = (stage_ == Stage::kLegs || stage_ == Stage::kLooks) && control.OnPath() &&
                      control.heard().drive->mode == DriveMode::kFollowing;
  if (drives && std::max(holds_.Stands_s(control), idles_.Stands_s(control)) <= config_.stands_s)
    return false;
  holds_.Reset();
  idles_.Reset();
  return drives;
}

void LocateMission::Listen(const MissionControl& control) {
  const Heard& heard = control.heard();
  if (control.IsPlacing() && stage_ == Stage::kFraming && evidence_.log().empty()) return;
  evidence_.OnPose(heard.pose->stamp, heard.pose->map_from_base, heard.corrected);
  for (const SeenFeature& seen : heard.told) evidence_.OnFeature(seen, control.now());
  if (evidence_.log().empty() || !heard.drive || !heard.drive->nearest) return;
  const ThingNear& nearest = *heard.drive->nearest;
  evidence_.met().OnEcho(evidence_.log().way_from_base() * nearest.at, nearest.free_m);
}

/// Something is in the way: it is there for legs and for ways to views.
void LocateMission::NoteStop(const MissionControl& control) {
  const Pose2& way_from_told = evidence_.log().way_from_told();
  if (const auto thing = ThingAhead(control, footprint_, config_.thing_m))
    evidence_.met().OnStop({way_from_told * thing->map_from_centre, thing->half_m});
}

/// The robot's pose is wrong, and how well it believes to know it says nothing of the way from here. So the
/// way has a frame of its own, which begins here and is exact.
void LocateMission::Frame(MissionControl& control) {
  stage_ = Stage::kFraming;
  framed_ = true;
  control.OrderPlace(control.heard().pose->map_from_base, kFrame_m, kFrame_rad);
  Tell(control, "begins");
}

/// Whether the robot has obeyed, and has sent a pose since.
bool LocateMission::IsPlaced(const MissionControl& control) const {
  const Heard& heard = control.heard();
  return !control.IsPlacing() && heard.corrected && heard.pose->stamp > *heard.corrected;
}

bool LocateMission::OrderLeg(MissionControl& control) {
  if (!legs_.Next(control, evidence_, looks_.Rivals())) return false;
  stage_ = Stage::kLegs;
  return true;
}

void LocateMission::NextLeg(MissionControl& control) {
  if (PositionSigma(control.heard().pose->covariance) > config_.drift_m) return Frame(control);
  if (!OrderLeg(control)) {
    stage_ = Stage::kSettling;
    return;
  }
  Tell(control, fmt::format("leg {}", legs_.driven()));
}

void LocateMission::EndLeg(MissionControl& control) {
  stands_since_ = control.now();
  evidence_.Search();
  looks_.Take(evidence_);
  // What is known already once the robot stands may save the next leg. Places that look alike from before a
  // door are told apart by walls alone.
  const bool enough = legs_.IsEnough(evidence_);
  if (!enough || looks_.IsUndecided()) return NextLeg(control);
  stage_ = Stage::kSettling;
}

/// Standing, until the radio has brought all that is new.
bool LocateMission::HasSettled(const MissionControl& control) const {
  return Seconds(control.now() - std::max(evidence_.changed(), stands_since_)) > config_.settle_s;
}

void LocateMission::Decide(MissionControl& control) {
  evidence_.Search();
  looks_.Take(evidence_);
  const int held = evidence_.CountHeld();
  if (held > 0 && held <= config_.most_tests) {
    stage_ = Stage::kLooks;
    ++round_;
    return Follow(control, looks_.Next(control, evidence_));
  }
  // What came while the robot stood may show another leg.
  if (OrderLeg(control)) return;
  GiveUp(control,
         looks_.hypotheses().empty() ? "no place on the plan explains what was heard" : Candidates());
}

void LocateMission::Follow(MissionControl& control, LocateLooks::Progress progress) {
  switch (progress) {
    case LocateLooks::Progress::kUnderWay:
      if (control.state().text.find(looks_.doing()) == std::string::npos) Tell(control, looks_.doing());
      return;
    case LocateLooks::Progress::kSeen:
      return Believe(control);
    case LocateLooks::Progress::kRefused:
      return GiveUp(control, "the robot does not take the place that was found");
    case LocateLooks::Progress::kNothingLeft:
      return AfterLooks(control);
  }
}

/// No door has told: more walls, and doors from elsewhere, may.
void LocateMission::AfterLooks(MissionControl& control) {
  if (round_ < config_.rounds && OrderLeg(control))
    return Tell(control, fmt::format("no door told, leg {}", legs_.driven()));
  if (looks_.hypotheses().size() == 1) return BelieveWalls(control);
  GiveUp(control, Candidates());
}

void LocateMission::Believe(MissionControl& control) {
  framed_ = false;
  const RobotPose& pose = *control.heard().pose;
  control.Enter(Phase::kDone,
                fmt::format("at {}, known to {:.2f} m: {}, {} walls, {:.1f} m driven",
                            CandidateText(pose.map_from_base), PositionSigma(pose.covariance), looks_.doing(),
                            looks_.tested().matched, evidence_.log().driven_m()));
}

void LocateMission::BelieveWalls(MissionControl& control) {
  const auto found = evidence_.SearchWithin(config_.alone_margin);
  const PlaceHypothesis& only = looks_.hypotheses().front();
  const Pose2& way_from_base = evidence_.log().way_from_base();
  const bool sure =
      found.size() == 1 && found.front().IsPoint() && found.front().matched >= config_.alone_walls;
  if (!sure)
    return GiveUp(control, fmt::format("unconfirmed: {}, no door in sight tells",
                                       CandidateText(only.map_from_way * way_from_base)));
  control.OrderPlace(found.front().map_from_base, only.sigma_m, only.sigma_yaw_rad);
  framed_ = false;
  control.Enter(Phase::kDone, fmt::format("at {}, by {} walls alone, {:.1f} m driven",
                                          CandidateText(found.front().map_from_base), found.front().matched,
                                          evidence_.log().driven_m()));
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
  const WayLog& log = evidence_.log();
  control.OrderPlace(log.empty() ? control.heard().pose->map_from_base : log.way_from_base(), kUnknown_m,
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
  if (stage_ == Stage::kLegs || (stage_ == Stage::kLooks && looks_.IsOnItsWay())) NoteStop(control);
  if (stage_ == Stage::kLegs) {
    legs_.OnBlocked(evidence_);
    control.OrderPath({}, 0);
    return EndLeg(control);
  }
  if (stage_ == Stage::kLooks) Follow(control, looks_.OnBlocked(control, evidence_));
}

std::string LocateMission::Unfinished() const {
  return looks_.hypotheses().empty() ? "not found where it is" : Candidates();
}

std::string LocateMission::Candidates() const {
  constexpr std::size_t kShown = 3;
  const auto& places = looks_.hypotheses();
  std::string text = fmt::format("ambiguous: {} places:", places.size());
  for (std::size_t i = 0; i < std::min(kShown, places.size()); ++i)
    text += (i > 0 ? "; " : " ") + CandidateText(places[i].map_from_way * evidence_.log().way_from_base());
  return text + (places.size() > kShown ? "; ..." : "");
}

void LocateMission::Tell(MissionControl& control, const std::string& what) const {
  const WayLog& log = evidence_.log();
  control.Enter(
      Phase::kDriving,
      fmt::format("finding out where it is: {} ({} walls heard, {:.1f} m driven, {} places)", what,
                  log.empty() ? 0 : log.way().pieces.size(), log.driven_m(), evidence_.found().size()));
}

}  // namespace priamos::planner
