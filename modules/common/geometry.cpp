#include "common/geometry.hpp"

#include <algorithm>

namespace priamos {

Pose2 Integrate(const Pose2& pose, const Twist2& twist, double seconds) {
  const double turn = twist.wz * seconds;
  // sin(a)/a and (1-cos(a))/a, by their series where the quotient loses digits.
  const double s = std::abs(turn) < 1e-4 ? 1 - turn * turn / 6 : std::sin(turn) / turn;
  const double c = std::abs(turn) < 1e-4 ? turn / 2 : (1 - std::cos(turn)) / turn;
  const Pose2 step{(s * twist.vx - c * twist.vy) * seconds, (c * twist.vx + s * twist.vy) * seconds, turn};
  return pose * step;
}

double DistanceToSegment(const Eigen::Vector2d& begin, const Eigen::Vector2d& end,
                         const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = end - begin;
  const double length2 = along.squaredNorm();
  const double part = length2 > 0 ? std::clamp((point - begin).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (begin + part * along - point).norm();
}

}  // namespace priamos
