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
/// So often a model is sent that the head still does not have.
constexpr int kMostModels = 6;
/// Candidates of two searches that are one.
constexpr double kSameView_m = 0.6, kSame_rad = 0.2;

/// Whether a look shows that no door is there. A head that does not answer is taken for one without a model.
bool IsMiss(const LookResult& result) {
  return !result.ok && !result.no_model && !result.elsewhere;
}

bool AreOne(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < kSameView_m &&
         std::abs(WrapAngle(a.yaw - b.yaw)) < kSame_rad;
}

PlaceHypothesis HypothesisOf(const PlaceCandidate& c, const Pose2& way_from_base) {
  return {.map_from_way = c.map_from_base * way_from_base.Inverse(),
          .sigma_m = std::max(kLeast_m, PositionSigma(c.covariance)),
          .sigma_yaw_rad = std::max(kLeast_rad, std::sqrt(c.covariance(2, 2))),
          .score = c.score,
          .matched = c.matched,
          .held = c.IsHeld()};
}

std::vector<Rectangle> On(const Pose2& map_from_way, const std::vector<Rectangle>& things) {
  std::vector<Rectangle> moved;
  moved.reserve(things.size());
  for (const Rectangle& thing : things) moved.push_back({map_from_way * thing.map_from_centre, thing.half_m});
  return moved;
}

/// The way back along what was driven, so far: frame of the way.
std::vector<Pose2> WayBack(const DrivenWay& way, double back_m) {
  const std::vector<Pose2> trail = WithoutLoops(way.trail);
  std::size_t to = trail.size() - 1;
  for (double left_m = back_m; to > 0 && left_m > 0; --to)
    left_m -= (trail[to].translation() - trail[to - 1].translation()).norm();
  return AlongTrail(trail, trail.size() - 1, to);
}

}  // namespace

void LocateLooksConfig::Describe(Archive& a) {
  a.Number("speed_m_s", speed_m_s, {"m/s", 0.05, 1, "on the way"});
  a.Number("lead", lead, {"-", 1, 50, "log-odds by which a place whose door was seen is believed"});
  a.Number("missed", missed, {"-", 0, 20, "log-odds against a place whose door was not seen"});
  a.Number("other_side", other_side, {"-", 0, 20, "and where its side of a door that was seen was not"});
  a.Integer("most_views", most_views, {"-", 1, 20, "views of the doors of one candidate"});
  a.Integer("most_stops", most_stops, {"-", 0, 20, "stops on the ways to them"});
  a.Number("back_m", back_m, {"m", 0.1, 3, "how far it goes back from what stopped it"});
  looks.Describe(a);
}

LocateLooks::LocateLooks(const LocateLooksConfig& config, const RoutePlannerConfig& route,
                         const Footprint& footprint, const GroundPlan& plan)
    : config_(config), plan_(plan), views_(route, footprint, plan), looks_(config.looks) {}

void LocateLooks::Reset() {
  hypotheses_.clear();
  sightings_.clear();
  placed_.reset();
  view_.reset();
  test_ = 0;
}

void LocateLooks::Take(const PlaceEvidence& evidence) {
  placed_.reset();
  // Walls that fit nowhere take nothing back of what was seen.
  if (evidence.found().empty() && !sightings_.empty()) return;
  const Pose2& way_from_base = evidence.log().way_from_base();
  std::vector<PlaceHypothesis> taken;
  for (const PlaceCandidate& c : evidence.found()) {
    PlaceHypothesis fresh = HypothesisOf(c, way_from_base);
    for (const PlaceHypothesis& known : hypotheses_) {
      if (!AreOne(known.map_from_way * way_from_base, c.map_from_base)) continue;
      fresh.missed = known.missed;
      fresh.wide = known.wide;
      fresh.confirmed = known.confirmed;
      fresh.spent = known.spent;
    }
    taken.push_back(std::move(fresh));
  }
  hypotheses_ = std::move(taken);
  Weigh();
  test_ = 0;
}

bool LocateLooks::IsSeen(const PlaceHypothesis& hypothesis) const {
  return std::all_of(sightings_.begin(), sightings_.end(), [&](const Pose2& way_from_door) {
    return views_.HasDoor(hypothesis.map_from_way * way_from_door);
  });
}

void LocateLooks::Weigh() {
  // A stretch may have the door at another of its places.
  for (PlaceHypothesis& hypothesis : hypotheses_)
    hypothesis.seen = !hypothesis.held || IsSeen(hypothesis) ? 0 : kNoDoor;
}

/// Whether a place whose door was seen is so much likelier than every other.
bool LocateLooks::Leads(std::size_t which) const {
  if (!hypotheses_[which].confirmed || hypotheses_[which].seen > 0) return false;
  // That a rival's side was not seen is little: now and then the head takes one side for the other, and every
  // second view of a door that is there shows none. The walls have to tell the rest.
  const double needed = hypotheses_[which].weight() - config_.lead;
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    const PlaceHypothesis& rival = hypotheses_[i];
    if (i != which && rival.score - rival.seen - std::min(rival.missed, config_.other_side) > needed)
      return false;
  }
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

std::vector<Pose2> LocateLooks::Rivals() const {
  std::vector<Pose2> rivals;
  const std::vector<std::size_t> order = ByWeight();
  for (const std::size_t i : order)
    if (hypotheses_[i].weight() >= hypotheses_[order.front()].weight() - config_.lead)
      rivals.push_back(hypotheses_[i].map_from_way);
  return rivals;
}

/// The best view of a door that tells this place from others. Where what was heard leaves no way to any, it
/// may be echoes of echoes that do not. A place whose door was seen is only told from others by another one.
std::optional<DoorView> LocateLooks::ViewOf(std::size_t which, const Pose2& place,
                                            const PlaceEvidence& evidence, From from) {
  const PlaceHypothesis& hypothesis = hypotheses_[which];
  const auto sides = hypothesis.confirmed ? DoorViews::Sides::kAlike : DoorViews::Sides::kDiffer;
  const DrivenWay way = evidence.log().way();
  std::vector<Pose2> others, trail;
  for (std::size_t i = 0; i < hypotheses_.size(); ++i)
    if (i != which && hypotheses_[i].held && hypotheses_[i].seen <= 0)
      others.push_back(hypotheses_[i].map_from_way * way.base());
  const Pose2 map_from_way = place * way.base().Inverse();
  for (const Pose2& spot : WithoutLoops(way.trail)) trail.push_back(map_from_way * spot);
  const auto things = On(map_from_way, evidence.met().stops()),
             echoes = On(map_from_way, evidence.met().Echoes(way.trail));
  views_.Know(WallsAt(way, map_from_way), things, echoes, place);
  if (from == From::kHere) return views_.Here(place, others, hypothesis.spent, sides);
  if (auto view = views_.Best(trail, others, hypothesis.spent, sides)) return view;
  views_.Know({}, things, echoes, place);
  return views_.Best(trail, others, hypothesis.spent, sides);
}

bool LocateLooks::IsToBeLookedAt(const PlaceHypothesis& hypothesis) const {
  return hypothesis.held && hypothesis.seen <= 0 && hypothesis.views < config_.most_views &&
         hypothesis.stops <= config_.most_stops;
}

/// What speaks against a place of which a view has shown no door: more, where the other side of it was seen.
double LocateLooks::MissedBy(const PlaceHypothesis& hypothesis) const {
  const bool other_side = std::any_of(sightings_.begin(), sightings_.end(), [&](const Pose2& way_from_door) {
    return DoorViews::AreAtOnePlace(view_->door.map_from_door(), hypothesis.map_from_way * way_from_door);
  });
  return other_side ? config_.other_side : config_.missed;
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
    doing_ = seen_;
    stage_ = Stage::kConcluding;
    return Progress::kUnderWay;
  }
  for (const From from : {From::kHere, From::kAnywhere})
    for (const std::size_t which : order) {
      if (!IsToBeLookedAt(hypotheses_[which])) continue;
      const Pose2 place = hypotheses_[which].map_from_way * evidence.log().way_from_base();
      if (auto view = ViewOf(which, place, evidence, from))
        return Test(control, evidence, which, std::move(*view));
    }
  return Progress::kNothingLeft;
}

/// Begins to look for a door as from that place.
LocateLooks::Progress LocateLooks::Test(MissionControl& control, PlaceEvidence& evidence, std::size_t which,
                                        DoorView view) {
  const Pose2 place = hypotheses_[which].map_from_way * evidence.log().way_from_base();
  view_ = std::move(view);
  doing_ = fmt::format("looks for door '{}' as from ({:.1f}, {:.1f}) {:.0f} deg", view_->door.name, place.x,
                       place.y, Degrees(place.yaw));
  if (placed_ == which) return Approach(control, evidence);
  Place(control, evidence, which);
  stage_ = Stage::kPlacing;
  return Progress::kUnderWay;
}

LocateLooks::Progress LocateLooks::Step(MissionControl& control, PlaceEvidence& evidence) {
  const Heard& heard = control.heard();
  switch (stage_) {
    case Stage::kPlacing:
      if (control.place_refused()) return Progress::kRefused;
      if (control.IsPlacing() || !heard.corrected || heard.pose->stamp <= *heard.corrected) break;
      return Approach(control, evidence);
    case Stage::kDriving:
      if (!HasArrived(control)) return Look(control, evidence);
      // What was not seen in passing says nothing of what is to be seen from here.
      looks_.ForgetFailures();
      stage_ = Stage::kLooking;
      break;
    case Stage::kBackingOff:
      if (HasArrived(control)) return Approach(control, evidence);
      break;
    case Stage::kLooking:
      return Look(control, evidence);
    case Stage::kConcluding:
      if (control.place_refused()) return Progress::kRefused;
      // The pose that is told then is one of after it.
      if (!control.IsPlacing() && heard.corrected && heard.pose->stamp > *heard.corrected)
        return Progress::kSeen;
      break;
  }
  return Progress::kUnderWay;
}

/// The way is planned anew: it begins where the robot is by now.
LocateLooks::Progress LocateLooks::Approach(MissionControl& control, PlaceEvidence& evidence) {
  const Pose2& place = control.heard().pose->map_from_base;
  view_ = ViewOf(test_, place, evidence, From::kHere);
  if (!view_) view_ = ViewOf(test_, place, evidence, From::kAnywhere);
  if (!view_) {
    hypotheses_[test_].views = config_.most_views;
    return Next(control, evidence);
  }
  looks_.Reset();
  n_good_ = n_elsewhere_ = n_missed_ = n_models_ = 0;
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

/// Whether the door that it drives to a view of is in sight on the way.
bool LocateLooks::IsInPassing(const Pose2& map_from_base) const {
  return DoorViews::IsInSight(view_->door.map_from_door().Inverse() * map_from_base);
}

LocateLooks::Progress LocateLooks::Look(MissionControl& control, PlaceEvidence& evidence) {
  for (const LookResult& result : control.heard().looks) looks_.OnResult(result);
  const auto result = looks_.Settle(control.now());
  if (result && result->ok) ++n_good_;
  if (result && IsMiss(*result)) ++n_missed_;
  if (result && result->elsewhere) ++n_elsewhere_;
  if (n_elsewhere_ >= kGoodLooks && !hypotheses_[test_].wide) {
    hypotheses_[test_].wide = true;
    Place(control, evidence, test_);
    stage_ = Stage::kPlacing;
    return Progress::kUnderWay;
  }
  if (result && result->no_model) {
    control.SendModel(*MakeLandmark(plan_, view_->door.id));
    if (++n_models_ <= kMostModels) looks_.ForgetFailures();  // it is on its way
  }
  if (n_good_ >= kGoodLooks) return Seen(control, evidence);
  if (looks_.Exhausted() && stage_ == Stage::kLooking) {
    PlaceHypothesis& tested = hypotheses_[test_];
    Spend(tested);
    if (n_good_ == 0 && n_missed_ >= kGoodLooks) tested.missed += MissedBy(tested);
    return Next(control, evidence);
  }
  const bool in_sight = stage_ == Stage::kLooking || IsInPassing(control.heard().pose->map_from_base);
  if (in_sight && looks_.Ready(control.now()) && !looks_.Exhausted())
    looks_.Asked(control.OrderLook(view_->door.id, looks_.next()), control.now());
  return Progress::kUnderWay;
}

/// The door was seen: places that have none there are out. The place is believed when it leads, unless the
/// walls, those heard on the way to the door included, have found another one meanwhile.
LocateLooks::Progress LocateLooks::Seen(MissionControl& control, PlaceEvidence& evidence) {
  PlaceHypothesis& tested = hypotheses_[test_];
  const Pose2 place = tested.map_from_way * evidence.log().way_from_base();
  if (stage_ == Stage::kDriving) control.OrderPath({}, 0);
  const auto& found = evidence.Search();
  const bool fits = found.empty() || std::any_of(found.begin(), found.end(), [&](const PlaceCandidate& c) {
                      return AreOne(c.map_from_base, place);
                    });
  if (!fits) {
    tested.views = config_.most_views;
    return Next(control, evidence);
  }
  doing_ = seen_ = fmt::format("door '{}' seen", view_->door.name);
  sightings_.push_back(tested.map_from_way.Inverse() * view_->door.map_from_door());
  Spend(tested);
  tested.confirmed = true;
  tested.missed = 0;  // something hid it
  Weigh();
  return Leads(test_) ? Progress::kSeen : Next(control, evidence);
}

LocateLooks::Progress LocateLooks::OnBlocked(MissionControl& control, PlaceEvidence& evidence) {
  const Pose2& way_from_told = evidence.log().way_from_told();
  PlaceHypothesis& tested = hypotheses_[test_];
  if (stage_ != Stage::kDriving && stage_ != Stage::kBackingOff) return Progress::kUnderWay;
  if (++tested.stops > config_.most_stops) {
    Spend(tested);
    control.OrderPath({}, 0);
    return Next(control, evidence);
  }
  if (stage_ == Stage::kBackingOff) return Approach(control, evidence);
  stage_ = Stage::kBackingOff;
  PlannedPath path;
  // Stopped again, it goes back farther.
  for (const Pose2& point : WayBack(evidence.log().way(), tested.stops * config_.back_m))
    path.points.push_back(way_from_told.Inverse() * point);
  path.leeway.assign(path.points.size(), {kLeastLeeway_m, kLeastLeeway_m});
  control.OrderPath(FirstPart(std::move(path)), config_.speed_m_s);
  return Progress::kUnderWay;
}

}  // namespace priamos::planner
