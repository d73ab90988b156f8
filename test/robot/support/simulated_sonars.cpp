#include "test/robot/support/simulated_sonars.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

// Half the cone of sound and the largest angle of incidence that reflects [rad], range [m]. Sound is heard
// well beside the nominal 7.5 degrees; the robot does not know that.
constexpr double kHalfCone = Radians(12), kSpecularLimit = Radians(30), kReach = 5, kLeast = 0.1;

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

std::vector<Surface> BoxSides(double x_min, double y_min, double x_max, double y_max) {
  const Eigen::Vector2d a(x_min, y_min), b(x_max, y_min), c(x_max, y_max), d(x_min, y_max);
  return {{a, b}, {b, c}, {c, d}, {d, a}};
}

SonarCycle SimulatedSonars::Listen(Time time, const Pose2& map_from_base) {
  SonarCycle cycle{.time = time};
  const Pose2 back = map_from_base.Inverse() * before_.value_or(map_from_base);
  before_ = map_from_base;
  for (int i = 0; i < kSonars; ++i) {
    const double share = (groups_ - 1 - i % groups_) / static_cast<double>(groups_);
    const Pose2 base = map_from_base * Pose2{share * back.x, share * back.y, share * back.yaw};
    double range = FirstEcho(base * BaseFromSonar(i, Footprint{}.Size()));
    if (rng_.Chance(false_echoes_)) range = rng_.Uniform(0.1, 3);
    cycle.range_m[static_cast<std::size_t>(i)] = range;
  }
  return cycle;
}

double SimulatedSonars::FirstEcho(const Pose2& map_from_sonar) {
  double first = kReach + 1;
  for (int ray = -5; ray <= 5; ++ray) {
    const double bearing = map_from_sonar.yaw + ray * kHalfCone / 5;
    const Eigen::Vector2d direction(std::cos(bearing), std::sin(bearing));
    for (const Surface& surface : surfaces_) {
      const Eigen::Vector2d along = surface.to - surface.from;
      const Eigen::Vector2d offset = surface.from - map_from_sonar.translation();
      const double det = Cross(direction, along);
      if (std::abs(det) < 1e-9) continue;
      const double range = Cross(offset, along) / det, part = Cross(offset, direction) / det;
      if (range < 0 || part < 0 || part > 1) continue;
      const double incidence = std::acos(std::min(1.0, std::abs(det) / along.norm()));
      const bool at_edge = std::min(part, 1 - part) * along.norm() < 0.02;
      if (incidence < kSpecularLimit || at_edge) first = std::min(first, range);
    }
  }
  if (first > kReach) return -1;
  return std::max(kLeast, first + rng_.Normal(0.005));
}

double SimulatedSonars::Gap(const Pose2& map_from_base) const {
  double gap = kReach;
  const Footprint footprint;
  for (const Surface& surface : surfaces_) {
    const double length = (surface.to - surface.from).norm();
    for (double travel = 0; travel <= length; travel += 0.01) {
      const Eigen::Vector2d point = surface.from + (surface.to - surface.from) * (travel / length);
      gap = std::min(gap, footprint.Distance(map_from_base.Inverse() * point));
    }
  }
  return gap;
}

}  // namespace priamos::robot
