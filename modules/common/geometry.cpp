#include "common/geometry.hpp"

namespace priamos {

Pose2 Integrate(const Pose2& pose, const Twist2& twist, double seconds) {
  const double turn = twist.wz * seconds;
  // sin(a)/a and (1-cos(a))/a, by their series where the quotient loses digits.
  const double s = std::abs(turn) < 1e-4 ? 1 - turn * turn / 6 : std::sin(turn) / turn;
  const double c = std::abs(turn) < 1e-4 ? turn / 2 : (1 - std::cos(turn)) / turn;
  const Pose2 step{(s * twist.vx - c * twist.vy) * seconds, (c * twist.vx + s * twist.vy) * seconds, turn};
  return pose * step;
}

}  // namespace priamos
