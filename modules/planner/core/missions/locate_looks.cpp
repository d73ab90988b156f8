#include "planner/core/missions/locate_looks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/principal_axes.hpp"
#include "planner/core/locate/leg_choice.hpp"
#include "planner/core/map/map_landmarks.hpp"
#include "planner/core/missions/path_progress.hpp"

namespace priamos::planner {
namespace {

/// Sightings that confirm a place.
constexpr int kGoodLooks = 2;
/// A place that walls tell is not told better than the plan has them.
constexpr double kLeast_m = 0.15, kLeast_rad = 0.05;
/// And one whose door was seen beside where it should be: a thing's depth off. The robot still drives with
/// it.
constexpr double kWide_m = 0.35, kWide_rad = 0.12;
/// Log-odds against a place that has no door where one was seen.
constexpr double kNoDoor = 20;
/// Candidates of two searches that are one.
constexpr double kSameView_m = 0.6, kSame_rad = 0.2;

bool AreOne(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < kSameView_m &&
         std::abs(WrapAngle(a.yaw - b.yaw)) < kSame_rad;
}

PlaceHypothesis HypothesisOf(const PlaceCandidate& c, const Pose2& way_from_base) {
  return {.map_from_way = c.map_from_base * way_from_base.Inverse(),
          .sigma_m = std::max(kLeast_m, PositionSigma(c.covariance)),
          .sigma_yaw_rad = std::max(kLeast_rad, std::sqrt(c.covariance(2, 2))),
          .score = c.score,
          .matched = c.matched};
}

/// The way back along what was driven, so far: frame of the way.
std::vector<Pose2> WayBack(const DrivenWay& way, double back_m) {
  std::size_t to = way.trail.size() - 1;
  for (double left_m = back_m; to > 0 && left_m > 0; --to)
    left_m -= (way.trail[to].translation() - way.trail[to - 1].translation()).norm();
  return AlongTrail(way.trail, way.trail.size() - 1, to);
}

}  // namespace

void LocateLooksConfig::Describe(Archive& a) {
  a.Number("speed_m_s", speed_m_s, {"m/s", 0.05, 1, "on the way"});
  a.Number("lead", lead, {"-", 1, 50, "log-odds by which a place whose door was seen is believed"});
  a.Number("missed", missed, {"-", 0, 20, "log-odds against a place whose door was not seen"});
  a.Integer("most_views", most_views, {"-", 1, 20, "views of the doors of one candidate"});
  a.Integer("most_stops", most_stops, {"-", 0, 20, "stops on the ways to them"});
  a.Number("back_m", back_m, {"m", 0.1, 3, "how far it goes back from what stopped it"});
  a.Number("thing_m", thing_m, {"m", 0.1, 3, "size that something in the way is taken to have"});
  looks.Describe(a);
}

LocateLooks::LocateLooks(const LocateLooksConfig& config, const RoutePlannerConfig& route,
                         const Footprint& footprint, const GroundPlan& plan)
    : config_(config),
      footprint_(footprint),
      plan_(plan),
      views_(route, footprint, plan),
      looks_(config.looks) {}

void LocateLooks::Reset() {
  hypotheses_.clear();
  things_.clear();
  sightings_.clear();
  placed_.reset();
  view_.reset();
  test_ = 0;
}

void LocateLooks::Take(const PlaceEvidence& evidence) {
  const Pose2& way_from_base = evidence.log().way_from_base();
  std::vector<PlaceHypothesis> taken;
  for (const PlaceCandidate& c : evidence.found()) {
    PlaceHypothesis fresh = HypothesisOf(c, way_from_base);
    for (const PlaceHypothesis& known : hypotheses_) {
      if (!AreOne(known.map_from_way * way_from_base, c.map_from_base)) continue;
      fresh.missed = known.missed;
      fresh.wide = known.wide;
      fresh.spent = known.spent;
    }
    taken.push_back(std::move(fresh));
  }
  hypotheses_ = std::move(taken);
  Weigh();
  placed_.reset();
  test_ = 0;
}

bool LocateLooks::IsSeen(const PlaceHypothesis& hypothesis) const {
  return std::all_of(sightings_.begin(), sightings_.end(), [&](const Pose2& way_from_door) {
    return views_.HasDoor(hypothesis.map_from_way * way_from_door);
  });
}

void LocateLooks::Weigh() {
  for (PlaceHypothesis& hypothesis : hypotheses_) hypothesis.seen = IsSeen(hypothesis) ? 0 : kNoDoor;
}

/// Whether a place whose door was seen is so much likelier than every other.
bool LocateLooks::Leads(std::size_t which) const {
  if (sightings_.empty() || hypotheses_[which].seen > 0) return false;
  for (std::size_t i = 0; i < hypotheses_.size(); ++i)
    if (i != which && hypotheses_[i].weight() > hypotheses_[which].weight() - config_.lead) return false;
  return true;
}

bool LocateLooks::IsUndecided() const {
  return !sightings_.empty() && (hypotheses_.empty() || !Leads(ByWeight().front()));
}

std::vector<std::size_t> LocateLooks::ByWeight() const {
  std::vector<std::size_t> order(hypotheses_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return hypotheses_[a].weight() > hypotheses_[b].weight();
  });
  return order;
}

/// The best view of a door that tells this place from others. Where what was heard leaves no way to any, it
/// may be echoes of echoes that do not.
std::optional<DoorView> LocateLooks::ViewOf(std::size_t which, const Pose2& place,
                                            const PlaceEvidence& evidence) {
  const DrivenWay way = evidence.log().way();
  std::vector<Pose2> others, trail;
  for (std::size_t i = 0; i < hypotheses_.size(); ++i)
    if (i != which && hypotheses_[i].seen <= 0) others.push_back(hypotheses_[i].map_from_way * way.base());
  const Pose2 map_from_way = place * way.base().Inverse();
  for (const Pose2& spot : way.trail) trail.push_back(map_from_way * spot);
  std::vector<Rectangle> things;
  for (const Rectangle& thing : things_)
    things.push_back({map_from_way * thing.map_from_centre, thing.half_m});
  views_.Know(WallsAt(way, map_from_way), things, place);
  if (auto view = views_.Best(trail, others, hypotheses_[which].spent)) return view;
  views_.Know({}, things, place);
  return views_.Best(trail, others, hypotheses_[which].spent);
}

/// Has the robot believe that it is there.
void LocateLooks::Place(MissionControl& control, const PlaceEvidence& evidence, std::size_t which) {
  const PlaceHypothesis& next = hypotheses_[which];
  test_ = which;
  placed_ = which;
  control.OrderPlace(next.map_from_way * evidence.log().way_from_base(),
                     next.wide ? std::max(kWide_m, next.sigma_m) : next.sigma_m,
                     next.wide ? std::max(kWide_rad, next.sigma_yaw_rad) : next.sigma_yaw_rad);
}

LocateLooks::Progress LocateLooks::Next(MissionControl& control, PlaceEvidence& evidence) {
  const std::vector<std::size_t> order = ByWeight();
  // Of one that was seen beside its place only the look itself tells where it is.
  if (!order.empty() && Leads(order.front()) && !hypotheses_[order.front()].wide) {
    Place(control, evidence, order.front());
    stage_ = Stage::kConcluding;
    return Progress::kUnderWay;
  }
  for (const std::size_t which : order) {
    const PlaceHypothesis& next = hypotheses_[which];
    if (next.seen > 0 || next.views >= config_.most_views || next.stops > config_.most_stops) continue;
    const Pose2 place = next.map_from_way * evidence.log().way_from_base();
    view_ = ViewOf(which, place, evidence);
    if (!view_) continue;
    doing_ = fmt::format("looks for door '{}' as from ({:.1f}, {:.1f}) {:.0f} deg", view_->door.name, place.x,
                         place.y, Degrees(place.yaw));
    if (placed_ == which) return Approach(control, evidence);
    Place(control, evidence, which);
    stage_ = Stage::kPlacing;
    return Progress::kUnderWay;
  }
  return Progress::kNothingLeft;
}

LocateLooks::Progress LocateLooks::Step(MissionControl& control, PlaceEvidence& evidence) {
  const Heard& heard = control.heard();
  switch (stage_) {
    case Stage::kPlacing:
      if (control.place_refused()) return Progress::kRefused;
      if (control.IsPlacing() || !heard.corrected || heard.pose->stamp <= *heard.corrected) break;
      return Approach(control, evidence);
    case Stage::kDriving:
      if (HasArrived(control)) stage_ = Stage::kLooking;
      break;
    case Stage::kBackingOff:
      if (HasArrived(control)) return Approach(control, evidence);
      break;
    case Stage::kLooking:
      return Look(control, evidence);
    case Stage::kConcluding:
      if (control.place_refused()) return Progress::kRefused;
      if (!control.IsPlacing()) return Progress::kSeen;
      break;
  }
  return Progress::kUnderWay;
}

/// The way is planned anew: it begins where the robot is by now.
LocateLooks::Progress LocateLooks::Approach(MissionControl& control, PlaceEvidence& evidence) {
  view_ = ViewOf(test_, control.heard().pose->map_from_base, evidence);
  if (!view_) {
    hypotheses_[test_].views = config_.most_views;
    return Next(control, evidence);
  }
  looks_.Reset();
  n_good_ = n_elsewhere_ = 0;
  control.SendModel(*MakeLandmark(plan_, view_->door.id));
  stage_ = view_->path.points.empty() ? Stage::kLooking : Stage::kDriving;
  if (stage_ == Stage::kLooking) return Progress::kUnderWay;
  control.OrderPath(FirstPart(view_->path), config_.speed_m_s);
  return Progress::kUnderWay;
}

/// This view is not tried again.
void LocateLooks::Spend(PlaceHypothesis& hypothesis) {
  hypothesis.spent.push_back({view_->door.id, view_->door_from_base});
  ++hypothesis.views;
}

LocateLooks::Progress LocateLooks::Look(MissionControl& control, PlaceEvidence& evidence) {
  for (const LookResult& result : control.heard().looks) looks_.OnResult(result);
  const auto result = looks_.Settle(control.now());
  if (result && result->ok) ++n_good_;
  if (result && result->elsewhere) ++n_elsewhere_;
  if (n_elsewhere_ >= kGoodLooks && !hypotheses_[test_].wide) {
    hypotheses_[test_].wide = true;
    Place(control, evidence, test_);
    stage_ = Stage::kPlacing;
    return Progress::kUnderWay;
  }
  if (result && result->no_model) control.SendModel(*MakeLandmark(plan_, view_->door.id));
  if (n_good_ >= kGoodLooks) return Seen(control, evidence);
  if (looks_.Exhausted()) {
    PlaceHypothesis& tested = hypotheses_[test_];
    Spend(tested);
    tested.missed += config_.missed;
    return Next(control, evidence);
  }
  if (looks_.Ready(control.now()))
    looks_.Asked(control.OrderLook(view_->door.id, looks_.next()), control.now());
  return Progress::kUnderWay;
}

/// The door was seen: places that have none there are out. The place is believed when it leads, unless the
/// walls, those heard on the way to the door included, have found another one meanwhile.
LocateLooks::Progress LocateLooks::Seen(MissionControl& control, PlaceEvidence& evidence) {
  PlaceHypothesis& tested = hypotheses_[test_];
  const Pose2 place = tested.map_from_way * evidence.log().way_from_base();
  const auto& found = evidence.Search();
  const bool fits = std::any_of(found.begin(), found.end(),
                                [&](const PlaceCandidate& c) { return AreOne(c.map_from_base, place); });
  if (!fits) {
    tested.views = config_.most_views;
    return Next(control, evidence);
  }
  doing_ = fmt::format("door '{}' seen", view_->door.name);
  sightings_.push_back(tested.map_from_way.Inverse() * view_->door.map_from_door());
  Spend(tested);
  Weigh();
  return Leads(test_) ? Progress::kSeen : Next(control, evidence);
}

LocateLooks::Progress LocateLooks::OnBlocked(MissionControl& control, PlaceEvidence& evidence) {
  const Pose2& way_from_told = evidence.log().way_from_told();
  PlaceHypothesis& tested = hypotheses_[test_];
  if (stage_ != Stage::kDriving && stage_ != Stage::kBackingOff) return Progress::kUnderWay;
  if (const auto thing = ThingAhead(control, footprint_, config_.thing_m))
    things_.push_back({way_from_told * thing->map_from_centre, thing->half_m});
  if (++tested.stops > config_.most_stops) {
    Spend(tested);
    control.OrderPath({}, 0);
    return Next(control, evidence);
  }
  if (stage_ == Stage::kBackingOff) return Approach(control, evidence);
  stage_ = Stage::kBackingOff;
  PlannedPath path;
  for (const Pose2& point : WayBack(evidence.log().way(), config_.back_m))
    path.points.push_back(way_from_told.Inverse() * point);
  control.OrderPath(FirstPart(std::move(path)), config_.speed_m_s);
  return Progress::kUnderWay;
}

}  // namespace priamos::planner
