#include "robot/core/motion/path_shape.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

// Points closer than this to the one before carry no shape; only the last one must be met.
constexpr double kLeastSegment = 0.02;
// Below this share of its arc length a path turns on the spot rather than leads somewhere.
constexpr double kLeastPace = 0.1;

}  // namespace

bool SameCourse(const Path& a, const Path& b) {
  const auto same = [](const Pose2& p, const Pose2& q) { return p.x == q.x && p.y == q.y && p.yaw == q.yaw; };
  return a.id == b.id && a.speed_m_s == b.speed_m_s && a.centre == b.centre &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same);
}

double LengthFrom(const Pose2& start, const Path& path) {
  double length_m = 0;
  Eigen::Vector2d from = start.translation();
  for (const Pose2& point : path.points) {
    length_m += (point.translation() - from).norm();
    from = point.translation();
  }
  return length_m;
}

void PathShapeConfig::Describe(Archive& a) {
  a.Number("corner_deviation_m", corner_deviation_m, {"m", 0.001, 0.5, "a rounded corner passes beside it"});
  a.Number("corner_deviation_deg", corner_deviation_deg,
           {"deg", 0.1, 30, "a rounded corner deviates so far in heading"});
  a.Number("corner_acceleration_m_s2", corner_acceleration_m_s2,
           {"m/s^2", 0.05, 3, "acceleration in rounded corners"});
  a.Number("corner_turn_acceleration_rad_s2", corner_turn_acceleration_rad_s2,
           {"rad/s^2", 0.05, 10, "angular acceleration in rounded corners"});
  a.Number("max_speed_m_s", max_speed_m_s, {"m/s", 0.05, 1.5, "fastest distance per time on any path"});
  a.Number("max_turn_rad_s", max_turn_rad_s, {"rad/s", 0.05, 2, "fastest turn on any path"});
  a.Number("braking_m_s2", braking_m_s2, {"m/s^2", 0.05, 3, "before corners and the last point"});
}

PathShape::PathShape(const PathShapeConfig& config, const Pose2& start, const Path& path)
    : braking_{.deceleration_m_s2 = config.braking_m_s2}, path_speed_(path.speed_m_s), end_(start) {
  for (std::size_t i = 0; i < path.points.size(); ++i)
    AddSegment(path.points[i], i < path.leeway.size() ? path.leeway[i] : Leeway{});
  Blend(config);
  LimitSpeeds(config);
}

void PathShape::AddSegment(const Pose2& to, const Leeway& leeway) {
  const auto extent = [&](const Pose2& from) {
    return std::max((to.translation() - from.translation()).norm(),
                    kTurnLever * std::abs(WrapAngle(to.yaw - from.yaw)));
  };
  if (!segments_.empty() && extent(end_) < kLeastSegment) {
    // The segment before goes to this point instead.
    end_ = {segments_.back().from.x(), segments_.back().from.y(), segments_.back().yaw};
    length_ = segments_.back().begin;
    segments_.pop_back();
  }
  Segment segment;
  segment.begin = length_;
  segment.length = std::max(extent(end_), 1e-6);
  segment.from = end_.translation();
  segment.direction = (to.translation() - segment.from) / segment.length;
  segment.yaw = end_.yaw;
  segment.turn = WrapAngle(to.yaw - end_.yaw) / segment.length;
  segment.leeway = leeway;
  length_ += segment.length;
  end_ = {to.x, to.y, segment.yaw + segment.turn * segment.length};
  segments_.push_back(segment);
}

void PathShape::Blend(const PathShapeConfig& config) {
  for (std::size_t i = 0; i + 1 < segments_.size(); ++i) {
    const Segment &before = segments_[i], &after = segments_[i + 1];
    // A parabola that leaves d before the corner passes it at d/4 times the change of direction.
    const double bend = (after.direction - before.direction).norm();
    const double turn = std::abs(after.turn - before.turn);
    double d = std::min(before.length, after.length) / 2;
    if (bend > 0) d = std::min(d, 4 * config.corner_deviation_m / bend);
    if (turn > 0) d = std::min(d, 4 * Radians(config.corner_deviation_deg) / turn);
    segments_[i].blend = d;
  }
}

void PathShape::LimitSpeeds(const PathShapeConfig& config) {
  limits_.clear();
  const double speed = std::min(path_speed_, config.max_speed_m_s);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& segment = segments_[i];
    const double end = segment.begin + segment.length;
    const double turn = std::abs(segment.turn);
    limits_.push_back({segment.begin, end, std::min(speed, config.max_turn_rad_s / std::max(turn, 1e-9))});
    if (i + 1 == segments_.size()) break;
    const Segment& next = segments_[i + 1];
    const double bend = (next.direction - segment.direction).norm();
    const double change = std::abs(next.turn - segment.turn);
    const double squared = 2 * segment.blend *
                           std::min(config.corner_acceleration_m_s2 / std::max(bend, 1e-9),
                                    config.corner_turn_acceleration_rad_s2 / std::max(change, 1e-9));
    const double sharper = std::max(std::abs(segment.turn), std::abs(next.turn));
    const double turning = config.max_turn_rad_s / std::max(sharper, 1e-9);
    limits_.push_back(
        {end - segment.blend, end + segment.blend, std::min({speed, std::sqrt(squared), turning})});
  }
}

Eigen::Vector2d PathShape::Point::left() const {
  const double pace = direction.norm();
  if (pace < kLeastPace) return {0, 0};
  return Eigen::Vector2d(-direction.y(), direction.x()) / pace;
}

Leeway PathShape::LeewayAt(double s) const {
  return segments_.empty() ? Leeway{} : segments_[SegmentAt(std::clamp(s, 0.0, length_))].leeway;
}

PathShape::Point PathShape::At(double s) const {
  if (segments_.empty()) return {{end_.x, end_.y, WrapAngle(end_.yaw)}};
  const double inside = std::clamp(s, 0.0, length_);
  const std::size_t i = SegmentAt(inside);
  const Segment& segment = segments_[i];
  if (i > 0 && inside < segment.begin + segments_[i - 1].blend)
    return OnBlend(segments_[i - 1], segment, inside);
  if (i + 1 < segments_.size() && inside > segment.begin + segment.length - segment.blend)
    return OnBlend(segment, segments_[i + 1], inside);
  return OnSegment(segment, inside);
}

double PathShape::SpeedAt(double s) const {
  double fastest = braking_.SpeedBefore(0, length_ - s);
  for (const SpeedLimit& limit : limits_)
    if (limit.end >= s) fastest = std::min(fastest, braking_.SpeedBefore(limit.speed, limit.begin - s));
  return fastest;
}

double PathShape::RemainingDistance(double s) const {
  double travel = 0;
  for (const Segment& segment : segments_) {
    const double left = std::clamp(segment.begin + segment.length - s, 0.0, segment.length);
    travel += left * segment.direction.norm();
  }
  return travel;
}

double PathShape::Project(const Pose2& pose, double guess) const {
  constexpr int kIterations = 20;
  constexpr double kMostStep = 0.1;
  double s = std::clamp(guess, 0.0, length_);
  for (int i = 0; i < kIterations; ++i) {
    const Point at = At(s);
    const double along = at.direction.dot(pose.translation() - at.pose.translation()) +
                         kTurnLever * kTurnLever * at.turn * WrapAngle(pose.yaw - at.pose.yaw);
    const double norm = at.direction.squaredNorm() + kTurnLever * kTurnLever * at.turn * at.turn;
    const double step = std::clamp(along / std::max(norm, 0.1), -kMostStep, kMostStep);
    const double next = std::clamp(s + step, 0.0, length_);
    if (std::abs(next - s) < 1e-6) return next;
    s = next;
  }
  return s;
}

PathShape::Point PathShape::OnSegment(const Segment& segment, double s) const {
  const double travel = s - segment.begin;
  const Eigen::Vector2d p = segment.from + segment.direction * travel;
  return {{p.x(), p.y(), WrapAngle(segment.yaw + segment.turn * travel)}, segment.direction, segment.turn};
}

PathShape::Point PathShape::OnBlend(const Segment& before, const Segment& after, double s) const {
  const double d = before.blend;
  const double u = (s - (after.begin - d)) / (2 * d);
  Point point = OnSegment(before, s);
  // The parabola that is tangent to both segments d before and d behind the corner.
  const Eigen::Vector2d p = point.pose.translation() + (after.direction - before.direction) * (d * u * u);
  point.pose = {p.x(), p.y(), WrapAngle(point.pose.yaw + (after.turn - before.turn) * (d * u * u))};
  point.direction = before.direction + (after.direction - before.direction) * u;
  point.turn = before.turn + (after.turn - before.turn) * u;
  return point;
}

std::size_t PathShape::SegmentAt(double s) const {
  std::size_t i = 0;
  while (i + 1 < segments_.size() && s >= segments_[i + 1].begin) ++i;
  return i;
}

}  // namespace priamos::robot
