#include "planner/core/locate/met_things.hpp"

#include <algorithm>

namespace priamos::planner {
namespace {

/// An echo from farther away is of a wide cone.
constexpr double kNear_m = 0.5;
/// Echoes nearer to each other are one; half the side of its square.
constexpr double kSame_m = 0.15, kHalf_m = 0.1;
/// Nearer to the middle of a base nothing can be: half its width.
constexpr double kUnderBase_m = 0.35;

}  // namespace

void MetThings::Reset() {
  *this = {};
}

void MetThings::OnEcho(const Eigen::Vector2d& at, double free_m) {
  if (free_m > kNear_m) return;
  const bool known = std::any_of(echoes_.begin(), echoes_.end(),
                                 [&](const Eigen::Vector2d& echo) { return (echo - at).norm() < kSame_m; });
  if (!known) echoes_.push_back(at);
}

std::vector<Rectangle> MetThings::Echoes(const std::vector<Pose2>& trail) const {
  std::vector<Rectangle> squares;
  for (const Eigen::Vector2d& echo : echoes_) {
    const bool gone = std::any_of(trail.begin(), trail.end(), [&](const Pose2& spot) {
      return (spot.translation() - echo).norm() < kUnderBase_m;
    });
    if (!gone) squares.push_back({{echo.x(), echo.y(), 0}, Eigen::Vector2d::Constant(kHalf_m)});
  }
  return squares;
}

}  // namespace priamos::planner
