#include "planner/core/missions/locate_legs.hpp"

#include <algorithm>
#include <utility>

namespace priamos::planner {

void LocateLegsConfig::Describe(Archive& a) {
  a.Number("speed_m_s", speed_m_s, {"m/s", 0.05, 1, "on the way"});
  a.Number("leeway_m", leeway_m, {"m", 0, 2, "how far a leg may be left around things"});
  a.Number("most_m", most_m, {"m", 2, 500, "driven in search of walls"});
  a.Integer("most_legs", most_legs, {"-", 2, 200, "legs driven in search of walls"});
  a.Integer("same_legs", same_legs, {"-", 1, 20, "legs without fewer candidates that end the search"});
  a.Number("same_m", same_m, {"m", 1, 100, "driven at least before that ends it"});
  a.Number("lead", lead, {"-", 0, 50, "log-odds by which a candidate is behind that counts for nothing"});
  a.Integer("few", few, {"-", 1, 20, "candidates that are looked at without another leg"});
  a.Integer("few_matched", few_matched, {"-", 2, 50, "walls that the best of them has by then"});
  a.Section("choice", choice, "where to drive without a map");
}

void LocateLegs::Reset() {
  *this = LocateLegs(config_);
}

std::vector<Pose2> LocateLegs::Choose(const PlaceEvidence& evidence, LegHints hints) const {
  const DrivenWay way = evidence.log().way();
  const auto& stops = evidence.met().stops();
  hints.things.assign(stops.begin() + static_cast<std::ptrdiff_t>(forgiven_), stops.end());
  if (const auto leg = ChooseLeg(config_.choice, way, hints)) return {*leg};
  return ChooseWayBack(config_.choice, way, hints);
}

bool LocateLegs::Next(MissionControl& control, const PlaceEvidence& evidence, std::vector<Pose2> rivals) {
  const WayLog& log = evidence.log();
  if (log.driven_m() > config_.most_m || legs_ >= config_.most_legs) return false;
  LegHints hints{closed_, {}, std::move(rivals), &evidence.plan()};
  std::vector<Pose2> points = Choose(evidence, hints);
  if (points.empty() && !forgave_) {
    forgave_ = true;
    forgiven_ = evidence.met().stops().size();
    closed_.clear();
    hints.closed.clear();
    points = Choose(evidence, std::move(hints));
  }
  if (points.empty()) return false;
  ++legs_;
  towards_ = (points.front().translation() - log.way_from_base().translation()).normalized();
  PlannedPath path;
  for (const Pose2& point : points) path.points.push_back(log.way_from_told().Inverse() * point);
  path.leeway.assign(points.size(), {config_.leeway_m, config_.leeway_m});
  control.OrderPath(FirstPart(std::move(path)), config_.speed_m_s);
  return true;
}

bool LocateLegs::IsEnough(const PlaceEvidence& evidence) {
  const auto rivals = evidence.Rivals(config_.lead);
  same_legs_ = !rivals.empty() && rivals.size() == count_before_ ? same_legs_ + 1 : 0;
  count_before_ = rivals.size();
  if (rivals.empty()) return false;
  const bool held =
      std::all_of(rivals.begin(), rivals.end(), [](const PlaceCandidate& c) { return c.IsHeld(); });
  if (evidence.found().size() == 1 && rivals.front().IsPoint()) return true;
  if (held && rivals.size() <= std::size_t(config_.few) && rivals.front().matched >= config_.few_matched)
    return true;
  return same_legs_ >= config_.same_legs && evidence.log().driven_m() >= config_.same_m;
}

void LocateLegs::OnBlocked(const PlaceEvidence& evidence) {
  closed_.push_back({evidence.log().way_from_base().translation(), towards_});
}

}  // namespace priamos::planner
