#include "robot/core/sonar/point_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace priamos::robot {
namespace {

using Eigen::Vector2d;

/// Of a place that is voted for it is known that it lies in a cell of 10 cm or beside it.
constexpr double kVoted_m = 0.12;
/// More echoes are not kept of one place, or of none: the newest ones count.
constexpr std::size_t kMostOfOne = 60, kMostOfNone = 1200;
/// What is heard so far behind a place is not it; so far from it, in the range, it is.
constexpr double kBehind_m = 0.2, kAt_m = 0.1;

}  // namespace

void PointFinderConfig::Describe(Archive& a) {
  a.Number("window_m", window_m, {"m", 0.5, 10, "an echo waits until the base has driven so far"});
  a.Number("window_s", window_s, {"s", 1, 120, "or until this time has passed"});
  a.Integer("votes", votes, {"-", 4, 200, "echoes through one place that are looked at closely"});
  a.Number("gate_m", gate_m, {"m", 0.005, 0.3, "an echo so far off is one of a place that is known"});
  a.Number("keep_m", keep_m, {"m", 0.5, 50, "a place takes no more when it was not heard for so far"});
  a.Number("through_m", through_m, {"m", 0.3, 5, "from so near a place is heard by a beam"});
  a.Number("through_deg", through_deg, {"deg", 1, 15, "that points so near to it"});
  a.Integer("through", through, {"-", 4, 180, "directions from which beams saw through it: it has gone"});
  a.Section("fit", fit, "which echoes are those of one place");
}

PointFinder::PointFinder(const PointFinderConfig& config, const OdometryNoise& odometry)
    : config_(config), odometry_(odometry), waiting_({config.window_m, config.window_s, kMostOfNone}) {}

std::vector<const FoundPoint*> PointFinder::Add(std::span<const PlacedEcho> unexplained, Time now) {
  std::vector<const FoundPoint*> changed;
  if (!unexplained.empty()) Forget(now, unexplained.back().travel_m);
  std::vector<PlacedEcho> rest;
  for (const PlacedEcho& echo : unexplained)
    if (!Grow(echo, now, changed)) rest.push_back(echo);
  for (const PlacedEcho& echo : rest) waiting_.Add(echo, now);
  if (const FoundPoint* found = Begin(rest, now)) changed.push_back(found);
  return changed;
}

bool PointFinder::Explains(const PlacedEcho& echo) const {
  return std::any_of(points_.begin(), points_.end(), [&](const Point& point) {
    return MayComeFrom(echo, point.found.fit.at, config_.gate_m, config_.fit);
  });
}

std::vector<int> PointFinder::SeeThrough(std::span<const PlacedEcho> heard) {
  std::vector<int> gone;
  for (Point& point : points_) {
    for (const PlacedEcho& echo : heard) NoteSight(echo, point);
    if (static_cast<int>(point.seen_through_from.count()) >= config_.through)
      gone.push_back(point.found.number);
  }
  std::erase_if(points_, [&](const Point& point) {
    return std::find(gone.begin(), gone.end(), point.found.number) != gone.end();
  });
  return gone;
}

/// A base that stands, or many beams of one direction, tell no more than one.
void PointFinder::NoteSight(const PlacedEcho& echo, Point& point) const {
  const Vector2d there = echo.odom_from_sonar.Inverse() * point.found.fit.at;
  const double distance_m = there.norm();
  if (distance_m > config_.through_m ||
      std::abs(std::atan2(there.y(), there.x())) > Radians(config_.through_deg))
    return;
  if (std::abs(echo.range_m - distance_m) < kAt_m) return void(point.seen_through_from.reset());
  if (echo.range_m < distance_m + kBehind_m) return;
  const Vector2d from = echo.odom_from_sonar.translation() - point.found.fit.at;
  const double part = (std::atan2(from.y(), from.x()) + kPi) / (2 * kPi);
  const auto directions = static_cast<double>(point.seen_through_from.size());
  point.seen_through_from.set(static_cast<std::size_t>(std::min(directions - 1, directions * part)));
}

void PointFinder::Forget(Time now, double travel_m) {
  waiting_.Forget(now, travel_m);
  std::erase_if(points_,
                [&](const Point& point) { return travel_m - point.found.travel_m > config_.keep_m; });
}

/// Gives an echo to the newest place that takes it. Returns whether there is one.
bool PointFinder::Grow(const PlacedEcho& echo, Time now, std::vector<const FoundPoint*>& changed) {
  const auto takes = [&](const Point& point) {
    return MayComeFrom(echo, point.found.fit.at, config_.gate_m, config_.fit);
  };
  const auto point = std::find_if(points_.rbegin(), points_.rend(), takes);
  if (point == points_.rend()) return false;
  point->echoes.push_back(echo);
  if (point->echoes.size() > kMostOfOne) point->echoes.erase(point->echoes.begin());
  point->seen_through_from.reset();
  point->found.heard = now;
  point->found.travel_m = echo.travel_m;
  // The newest echoes alone may come from one direction: what was known better before stays.
  if (const auto fit = FitPoint(point->echoes, point->found.fit.at, config_.fit, odometry_))
    point->found.fit = *fit;
  if (std::find(changed.begin(), changed.end(), &point->found) == changed.end())
    changed.push_back(&point->found);
  return true;
}

/// A place that begins with the newest echoes and those before them, where most arcs cross; nullptr: none
/// does.
const FoundPoint* PointFinder::Begin(std::span<const PlacedEcho> newest, Time now) {
  VotedPlace voted;
  for (const PlacedEcho& echo : newest)
    if (const VotedPlace best = waiting_.votes().Best(echo); best.votes > voted.votes) voted = best;
  if (voted.votes < config_.votes) return nullptr;
  const Vector2d place = Refined(voted.at);
  std::vector<PlacedEcho> echoes = Supporters(place, config_.gate_m);
  const auto fit = FitPoint(echoes, place, config_.fit, odometry_);
  if (!fit) return nullptr;
  waiting_.Release(
      [&](const PlacedEcho& echo) { return MayComeFrom(echo, fit->at, config_.gate_m, config_.fit); });
  const PlacedEcho last = echoes.back();
  const Vector2d off = fit->at - last.odom_from_base.translation();
  points_.push_back(
      {{++last_number_, now, *fit, std::atan2(off.y(), off.x()), last.travel_m}, std::move(echoes)});
  return &points_.back().found;
}

/// Closer to the place that most echoes around a voted one agree on: outliers go step by step.
Vector2d PointFinder::Refined(Vector2d place) const {
  PointFitConfig rough = config_.fit;
  rough.most_rms = std::numeric_limits<double>::infinity();
  rough.surplus = -std::numeric_limits<double>::infinity();
  for (double gate_m = kVoted_m; gate_m > config_.gate_m; gate_m /= 2)
    if (const auto fit = FitPoint(Supporters(place, gate_m), place, rough, odometry_)) place = fit->at;
  return place;
}

std::vector<PlacedEcho> PointFinder::Supporters(const Vector2d& place, double gate_m) const {
  std::vector<PlacedEcho> echoes;
  waiting_.ForEach([&](const PlacedEcho& echo, std::size_t) {
    if (MayComeFrom(echo, place, gate_m, config_.fit)) echoes.push_back(echo);
  });
  if (echoes.size() > kMostOfOne) echoes.erase(echoes.begin(), echoes.end() - kMostOfOne);
  return echoes;
}

}  // namespace priamos::robot
