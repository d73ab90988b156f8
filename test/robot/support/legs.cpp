#include "test/robot/support/legs.hpp"

#include <cmath>

#include "common/geometry.hpp"

namespace priamos::robot {
namespace {

std::vector<Surface> RoundLeg(const Eigen::Vector2d& at) {
  constexpr int kFaces = 12;
  constexpr double kRadius_m = 0.075;
  const auto corner = [&](int i) -> Eigen::Vector2d {
    const double angle = 2 * kPi * i / kFaces;
    return at + kRadius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  std::vector<Surface> faces;
  faces.reserve(kFaces);
  for (int i = 0; i < kFaces; ++i) faces.push_back({corner(i), corner(i + 1)});
  return faces;
}

}  // namespace

std::vector<Surface> RoundLegs(const Eigen::Vector2d& at) {
  auto legs = RoundLeg(at - Eigen::Vector2d(0.11, 0));
  const auto right = RoundLeg(at + Eigen::Vector2d(0.11, 0));
  legs.insert(legs.end(), right.begin(), right.end());
  return legs;
}

}  // namespace priamos::robot
