#include "robot/core/sonar/line_votes.hpp"

#include <cmath>

namespace priamos::robot {
namespace {

constexpr double kAngle_rad = Radians(2), kDistance_m = 0.05;
/// A wall answers while its normal lies so near to the axis of a sensor.
constexpr double kHalfArc_rad = Radians(9);

int Wrapped(int index, int count) {
  return ((index % count) + count) % count;
}

/// Calls `visit(angle cell, distance cell)` for the lines that touch the arc of an echo.
template <class Visit>
void ForEachTangent(const PlacedEcho& echo, const Visit& visit) {
  const double axis_rad = echo.odom_from_sonar.yaw;
  const int first = static_cast<int>(std::ceil((axis_rad - kHalfArc_rad) / kAngle_rad));
  const int last = static_cast<int>(std::floor((axis_rad + kHalfArc_rad) / kAngle_rad));
  for (int angle = first; angle <= last; ++angle) {
    const Eigen::Vector2d normal(std::cos(angle * kAngle_rad), std::sin(angle * kAngle_rad));
    const double distance_m = normal.dot(echo.odom_from_sonar.translation()) + echo.range_m;
    visit(angle, static_cast<int>(std::floor(distance_m / kDistance_m)));
  }
}

}  // namespace

LineVotes::LineVotes() : cells_(std::size_t(kAngles) * kDistances) {}

void LineVotes::Vote(const PlacedEcho& echo, int change) {
  ForEachTangent(echo, [&](int angle, int distance) {
    auto& cell = cells_[std::size_t(Wrapped(angle, kAngles)) * kDistances +
                        std::size_t(Wrapped(distance, kDistances))];
    cell = static_cast<std::int16_t>(cell + change);
  });
}

int LineVotes::At(int angle, int distance) const {
  return cells_[std::size_t(Wrapped(angle, kAngles)) * kDistances +
                std::size_t(Wrapped(distance, kDistances))];
}

/// A line on the border of two cells has its votes in both.
VotedLine LineVotes::Best(const PlacedEcho& echo) const {
  VotedLine best;
  ForEachTangent(echo, [&](int angle, int distance) {
    const int votes = At(angle, distance - 1) + At(angle, distance) + At(angle, distance + 1);
    if (votes <= best.votes) return;
    best = {WrapAngle(angle * kAngle_rad), (distance + 0.5) * kDistance_m, votes};
  });
  return best;
}

}  // namespace priamos::robot
