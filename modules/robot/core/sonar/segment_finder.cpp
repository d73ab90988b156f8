#include "robot/core/sonar/segment_finder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "robot/core/sonar/point_fit.hpp"

namespace priamos::robot {
namespace {

/// What lies so near to a voted line may be on it.
constexpr double kNearLine_m = 0.06;
/// More echoes than this are not kept waiting: 24 sensors that tell something new every 2 cm for 2 m.
constexpr std::size_t kMostWaiting = 2400;

}  // namespace

void SegmentFinderConfig::Describe(Archive& a) {
  a.Number("window_m", window_m, {"m", 0.5, 10, "an echo waits until the base has driven so far"});
  a.Number("window_s", window_s, {"s", 1, 120, "or until this time has passed"});
  a.Number("moved_m", moved_m, {"m", 0.005, 0.2, "a sensor that has not moved so far tells nothing new"});
  a.Number("turned_deg", turned_deg, {"deg", 0.2, 15, "unless it has turned so much"});
  a.Integer("votes", votes, {"-", 6, 200, "echoes on one line that are looked at closely"});
  a.Number("surplus", surplus, {"-", 0, 1000, "a point explains them so much worse, in variances"});
  a.Number("least_m", least_m, {"m", 0.2, 3, "least length of a new segment"});
  a.Number("gap_m", gap_m, {"m", 0.05, 2, "echoes farther apart are not of one wall"});
  a.Number("keep_m", keep_m, {"m", 0.5, 50, "a segment grows no more when it was not heard for so far"});
  a.Integer("groups", groups, {"-", 1, kSonars, "groups of sensors that fire one after the other"});
  a.Number("cycle_s", cycle_s, {"s", 0.02, 1, "time for all groups to fire once"});
  a.Section("segment", segment, "which echoes are those of one wall");
}

SegmentFinder::SegmentFinder(const SegmentFinderConfig& config, const OdometryNoise& noise,
                             const Footprint& footprint)
    : config_(config), noise_(noise), waiting_({config.window_m, config.window_s, kMostWaiting}) {
  for (int i = 0; i < kSonars; ++i)
    base_from_sonar_[static_cast<std::size_t>(i)] = BaseFromSonar(i, footprint.Size());
}

std::vector<const FoundSegment*> SegmentFinder::Add(const SonarCycle& cycle, const Pose2& odom_from_base,
                                                    const OfPoint& of_point) {
  if (last_cycle_) travel_m_ += (odom_from_base.translation() - last_base_.translation()).norm();
  Forget(cycle.time);
  std::vector<const FoundSegment*> changed;
  heard_ = NewEchoes(cycle, odom_from_base);
  last_base_ = odom_from_base;
  last_cycle_ = cycle.time;
  unexplained_ = Explain(heard_, cycle.time, of_point, changed);
  for (const PlacedEcho& echo : unexplained_) waiting_.Add(echo, cycle.time);
  for (const PlacedEcho& echo : unexplained_) {
    if (const FoundSegment* found = Begin(echo, cycle.time)) {
      changed.push_back(found);
      break;
    }
  }
  return changed;
}

/// The cycle is stamped when its last group fires. A base that drives is centimetres behind when the first
/// one does, and one that turns has its sensors elsewhere.
Pose2 SegmentFinder::BaseWhenFired(std::size_t sensor, const SonarCycle& cycle,
                                   const Pose2& odom_from_base) const {
  const int groups_later = config_.groups - 1 - static_cast<int>(sensor) % config_.groups;
  const double earlier_s = config_.cycle_s * groups_later / config_.groups;
  const double since_s = last_cycle_ ? Seconds(cycle.time - *last_cycle_) : 0;
  if (!(since_s >= earlier_s) || groups_later == 0) return odom_from_base;
  const double share = earlier_s / since_s;
  const Pose2 back = odom_from_base.Inverse() * last_base_;
  return odom_from_base * Pose2{share * back.x, share * back.y, share * back.yaw};
}

/// A base that stands, or a sensor that moves along a wall no farther than its noise, does not count the same
/// echo many times.
std::vector<PlacedEcho> SegmentFinder::NewEchoes(const SonarCycle& cycle, const Pose2& odom_from_base) {
  std::vector<PlacedEcho> echoes;
  for (std::size_t i = 0; i < base_from_sonar_.size(); ++i) {
    const double range_m = cycle.range_m[i];
    // Written so that NaN is refused. The least range stands for all that is nearer.
    if (!(range_m > kSonarMin_m && range_m <= kSonarMax_m)) continue;
    const Pose2 at = BaseWhenFired(i, cycle, odom_from_base) * base_from_sonar_[i];
    const Pose2& before = taken_at_[i];
    const bool moved = (at.translation() - before.translation()).norm() >= config_.moved_m ||
                       std::abs(WrapAngle(at.yaw - before.yaw)) >= Radians(config_.turned_deg);
    if (std::exchange(taken_[i], true) && !moved) continue;
    taken_at_[i] = at;
    echoes.push_back({odom_from_base, at, range_m, travel_m_});
  }
  return echoes;
}

/// Gives each echo to the newest wall that takes it. Returns the others.
std::vector<PlacedEcho> SegmentFinder::Explain(std::vector<PlacedEcho> echoes, Time time,
                                               const OfPoint& of_point,
                                               std::vector<const FoundSegment*>& changed) {
  for (auto found = segments_.rbegin(); found != segments_.rend(); ++found) {
    const auto is_other = [&](const PlacedEcho& echo) {
      return !found->wall.Takes(echo) || (of_point && found->wall.EndsBefore(echo) && of_point(echo));
    };
    const auto own = std::partition(echoes.begin(), echoes.end(), is_other);
    if (own == echoes.end()) continue;
    if (found->wall.Add({own, echoes.end()})) {
      found->heard = time;
      echoes.erase(own, echoes.end());
    }
    changed.push_back(&*found);
  }
  return echoes;
}

void SegmentFinder::Forget(Time now) {
  waiting_.Forget(now, travel_m_);
  std::erase_if(segments_, [&](const FoundSegment& found) {
    return !found.wall.grows() || travel_m_ - found.wall.newest().travel_m > config_.keep_m;
  });
}

/// A wall that begins with what the newest echo and those before it show; nullptr when they show none.
const FoundSegment* SegmentFinder::Begin(const PlacedEcho& newest, Time time) {
  const VotedLine line = waiting_.votes().Best(newest);
  if (line.votes < config_.votes) return nullptr;
  const auto echoes = Supporters(line, newest);
  if (static_cast<int>(echoes.size()) < config_.votes) return nullptr;
  std::vector<RangeAt> series;
  series.reserve(echoes.size());
  const Pose2 base_from_odom = newest.odom_from_base.Inverse();
  for (const PlacedEcho& echo : echoes)
    series.push_back({base_from_odom * echo.odom_from_sonar, echo.range_m});
  if (!FitWall(series, config_.segment.range)) return nullptr;
  const auto fitted = FitSegment(echoes, line.angle_rad, config_.segment, noise_);
  if (!fitted) return nullptr;
  if (!IsRatherALine(echoes, line.angle_rad)) return nullptr;
  WallSegment wall(config_.segment, noise_, echoes, *fitted);
  if (wall.length_m() < config_.least_m) return nullptr;
  waiting_.Release([&](const PlacedEcho& echo) { return wall.Takes(echo); });
  segments_.push_back({++last_number_, time, std::move(wall)});
  return &segments_.back();
}

/// Whether a corner or an edge, heard on a part of its arc, surely explains the echoes worse.
bool SegmentFinder::IsRatherALine(const std::vector<PlacedEcho>& echoes, double angle_rad) const {
  const Eigen::Vector2d normal(std::cos(angle_rad), std::sin(angle_rad));
  Eigen::Vector2d middle(0, 0);
  for (const PlacedEcho& echo : echoes) middle += echo.Foot(normal) / static_cast<double>(echoes.size());
  const WallFitConfig& range = config_.segment.range;
  return PointOverLine(echoes, middle, {range.range_sigma_m, range.range_sigma_per_m}) < -config_.surplus;
}

/// The echoes near a line whose feet lie together with that of the newest echo, in order of time.
std::vector<PlacedEcho> SegmentFinder::Supporters(const VotedLine& line, const PlacedEcho& newest) const {
  const Eigen::Vector2d normal(std::cos(line.angle_rad), std::sin(line.angle_rad)),
      along(-normal.y(), normal.x());
  std::vector<std::pair<double, std::size_t>> feet;
  waiting_.ForEach([&](const PlacedEcho& echo, std::size_t i) {
    const Eigen::Vector2d foot = echo.Foot(normal);
    // The distance first: it refuses most, and is cheap.
    if (!(std::abs(normal.dot(foot) - line.distance_m) < kNearLine_m)) return;
    const double off_axis = std::abs(WrapAngle(line.angle_rad - echo.odom_from_sonar.yaw));
    if (off_axis < Radians(config_.segment.range.most_bearing_deg)) feet.emplace_back(along.dot(foot), i);
  });
  std::sort(feet.begin(), feet.end());
  const double own_m = along.dot(newest.Foot(normal));
  std::vector<std::size_t> together;
  double last_m = feet.empty() ? 0 : feet.front().first;
  for (const auto& [at_m, index] : feet) {
    if (at_m - last_m > config_.gap_m) {
      if (last_m >= own_m) break;
      together.clear();
    }
    together.push_back(index);
    last_m = at_m;
  }
  std::sort(together.begin(), together.end());
  std::vector<PlacedEcho> echoes;
  echoes.reserve(together.size());
  for (const std::size_t index : together) echoes.push_back(waiting_[index]);
  return echoes;
}

}  // namespace priamos::robot
