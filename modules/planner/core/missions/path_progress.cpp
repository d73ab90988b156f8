#include "planner/core/missions/path_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

/// Direction, of length 1, of the line on which a base is that has `remaining_m` of its path before it; zero
/// for a path without length.
Eigen::Vector2d DirectionLeft(const Pose2& base, const std::vector<Pose2>& points, double remaining_m) {
  for (std::size_t i = points.size(); i-- > 0;) {
    const Eigen::Vector2d from = i > 0 ? points[i - 1].translation() : base.translation();
    const Eigen::Vector2d line = points[i].translation() - from;
    remaining_m -= line.norm();
    if ((remaining_m <= 0 || i == 0) && line.norm() > 1e-6) return line.normalized();
  }
  return Eigen::Vector2d::Zero();
}

/// Distance from the middle of the footprint to its edge in a direction of the base frame [m].
double Reach(const Footprint& footprint, const Eigen::Vector2d& direction) {
  const double along_x = footprint.length_m / 2 / std::max(1e-9, std::abs(direction.x()));
  const double along_y = footprint.width_m / 2 / std::max(1e-9, std::abs(direction.y()));
  return std::min(along_x, along_y);
}

}  // namespace

std::vector<Pose2> PointsLeft(const std::vector<Pose2>& points, double remaining_m) {
  std::size_t first = points.size();
  while (first > 0) {
    --first;
    if (first == 0) break;
    remaining_m -= (points[first].translation() - points[first - 1].translation()).norm();
    if (remaining_m <= 0) break;
  }
  return {points.begin() + static_cast<std::ptrdiff_t>(first), points.end()};
}

bool HasArrived(const MissionControl& control) {
  const Heard& heard = control.heard();
  return heard.pose->stamp > *control.path_sent() && control.OnPath() &&
         heard.drive->mode == DriveMode::kArrived;
}

std::optional<Rectangle> ThingAhead(const MissionControl& control, const Footprint& footprint,
                                    double size_m) {
  const DriveReport& drive = *control.heard().drive;
  const Pose2& base = control.heard().pose->map_from_base;
  const Eigen::Vector2d ahead = DirectionLeft(base, control.path().points, drive.remaining_m);
  if (ahead.norm() < 0.5) return std::nullopt;
  return ThingMet(base, ahead, drive.nearest, footprint, size_m);
}

Rectangle ThingMet(const Pose2& base, const Eigen::Vector2d& ahead, const std::optional<ThingNear>& nearest,
                   const Footprint& footprint, double size_m) {
  const Eigen::Vector2d own_ahead = base.rotation().transpose() * ahead,
                        own_left(-own_ahead.y(), own_ahead.x());
  const Eigen::Vector2d met = nearest ? nearest->at : Reach(footprint, own_ahead) * own_ahead;
  const double off_middle = std::clamp(met.dot(own_left) / Reach(footprint, own_left), -1.0, 1.0);
  const Eigen::Vector2d middle = base * (met + size_m / 2 * (own_ahead + off_middle * own_left));
  return {{middle.x(), middle.y(), std::atan2(ahead.y(), ahead.x())}, Eigen::Vector2d::Constant(size_m / 2)};
}

double StandWatch::Stands_s(const MissionControl& control) {
  constexpr double kProgress_m = 0.05, kProgress_rad = 0.1, kLongestStep_s = 0.5;
  const DriveReport& drive = *control.heard().drive;
  const double heading = control.heard().pose->map_from_base.yaw;
  const double step_s = stepped_ ? std::min(Seconds(control.now() - *stepped_), kLongestStep_s) : 0;
  stepped_ = control.now();
  const bool free = drive.limit.empty() || drive.by_echo;
  const bool got_on = std::abs(drive.remaining_m - stood_at_m_) > kProgress_m ||
                      std::abs(WrapAngle(heading - stood_at_rad_)) > kProgress_rad;
  if (free != (counts_ == Counts::kFree) || got_on) {
    stood_at_m_ = drive.remaining_m;
    stood_at_rad_ = heading;
    stood_s_ = 0;
  } else if (IsFresh(*control.heard().pose, control.now())) {
    stood_s_ += step_s;
  }
  return stood_s_;
}

void ProgressWatch::SayWhatHolds(MissionControl& control, double held_s) {
  constexpr double kSaidAfter_s = 3;
  if ((held_s > kSaidAfter_s) == said_.has_value()) return;
  const std::string text = control.state().text;
  if (!said_) {
    said_ = Said{text, fmt::format("{}; the robot holds: {}", text, control.heard().drive->limit)};
    control.Enter(control.state().phase, said_->now);
    return;
  }
  // The mission may have said something else meanwhile.
  if (text == said_->now) control.Enter(control.state().phase, said_->before);
  said_.reset();
}

std::optional<Stop> ProgressWatch::Step(MissionControl& control, double held_s, double idle_s) {
  const double stands_s = holds_.Stands_s(control);
  SayWhatHolds(control, stands_s);
  if (stands_s > held_s) {
    control.Fail(
        fmt::format("the robot has held on its way for {:.0f} s: {}; next: see where it is, priamos place",
                    held_s, control.heard().drive->limit));
    return std::nullopt;
  }
  if (idles_.Stands_s(control) <= idle_s) return std::nullopt;
  idles_.Reset();
  return Stop{Stop::Cause::kBlocked, "the robot came no further"};
}

}  // namespace priamos::planner
