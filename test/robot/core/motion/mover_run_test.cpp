// The controller on a planned path, along which somebody comes who does not look where he goes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "test/robot/support/legs.hpp"
#include "test/robot/support/robot_rig.hpp"

namespace priamos::robot {
namespace {

/// Two walls along x.
std::vector<Surface> Hall() {
  return {{{-3, 1.1}, {20, 1.1}}, {{-3, -1.1}, {20, -1.1}}};
}

/// Two legs with the middle between them.
std::vector<Surface> Legs(double x_m, double y_m) {
  auto legs = BoxSides(x_m - 0.07, y_m + 0.04, x_m + 0.07, y_m + 0.18);
  const auto right = BoxSides(x_m - 0.07, y_m - 0.18, x_m + 0.07, y_m - 0.04);
  legs.insert(legs.end(), right.begin(), right.end());
  return legs;
}

/// Lets somebody walk from `from_m` to `to_m` along y = 0 at `speed_m_s`, up to the base at most, and on from
/// there when it is gone. Returns the base's fastest motion while he is within 10 cm of it [m/s].
double FastestBeside(RobotRig& rig, double from_m, double to_m, double speed_m_s, double seconds) {
  double x = from_m, fastest = 0;
  for (int i = 0; i < seconds * 50; ++i) {
    const double there = x + std::clamp(to_m - x, -speed_m_s / 50, speed_m_s / 50);
    rig.sonars().Clear();
    rig.sonars().Add(Legs(there, 0));
    if (rig.sonars().Gap(rig.base().truth()) > 0.02) x = there;
    rig.sonars().Clear();
    rig.sonars().Add(Legs(x, 0));
    const double gap_m = rig.sonars().Gap(rig.base().truth());
    rig.sonars().Add(Hall());
    rig.Tick();
    const Twist2 twist = rig.base().twist();
    if (gap_m < 0.1) fastest = std::max(fastest, std::hypot(twist.vx, twist.vy));
  }
  return fastest;
}

TEST(MoverRun, WhoWalksIntoTheBaseWalksIntoOneThatStands) {
  for (const double speed_m_s : {0.5, 0.8, 1.2})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      RobotRig rig(seed, {}, {}, {}, Hall());
      rig.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{8, 0, 0}}, .leeway = {{0.1, 0.1}}});
      EXPECT_LT(FastestBeside(rig, 6, -9, speed_m_s, 12), 0.03) << speed_m_s << " " << seed;
    }
}

/// Somebody slow, from `slant` off the side, who would meet the front corner of a base that drove on.
double FastestBesideWhoCrosses(std::uint64_t seed, double speed_m_s, double slant_rad) {
  constexpr double kMeets_s = 9, kCorner_m = 0.55;
  RobotRig rig(seed, {}, {}, {}, {});
  rig.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{8, 0, 0}}, .leeway = {{1, 1}}});
  const Eigen::Vector2d meets(0.3 * (kMeets_s - 0.7) + kCorner_m, 0.3);
  const Eigen::Vector2d velocity = speed_m_s * Eigen::Vector2d(-std::sin(slant_rad), -std::cos(slant_rad));
  Eigen::Vector2d at = meets - kMeets_s * velocity;
  double fastest = 0;
  for (int i = 0; i < 50 * (kMeets_s + 1); ++i) {
    const Eigen::Vector2d next = at + velocity / 50;
    rig.sonars().Clear();
    rig.sonars().Add(RoundLegs(next));
    if (rig.sonars().Gap(rig.base().truth()) > 0.02) at = next;
    rig.sonars().Clear();
    rig.sonars().Add(RoundLegs(at));
    const double gap_m = rig.sonars().Gap(rig.base().truth());
    rig.Tick();
    const Twist2 twist = rig.base().twist();
    if (gap_m < 0.08) fastest = std::max(fastest, std::hypot(twist.vx, twist.vy));
  }
  return fastest;
}

TEST(MoverRun, WhoComesSlowlyFromTheSideWalksIntoABaseThatStands) {
  for (const double speed_m_s : {0.5, 0.7, 0.9})
    for (const double slant_deg : {-20.0, 0.0, 30.0})
      for (std::uint64_t seed = 1; seed <= 2; ++seed)
        EXPECT_LT(FastestBesideWhoCrosses(seed, speed_m_s, Radians(slant_deg)), 0.05)
            << speed_m_s << " m/s, " << slant_deg << " degrees, seed " << seed;
}

TEST(MoverRun, WhoComesFastFromTheSideMeetsABaseThatIsAboutToStand) {
  for (const double slant_deg : {-20.0, 0.0, 30.0})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const double v = FastestBesideWhoCrosses(seed, 1.2, Radians(slant_deg));
      EXPECT_LT(v, 0.1) << slant_deg << " degrees, seed " << seed;
    }
}

TEST(MoverRun, WhoHasComeAndGoneBlocksNothing) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    RobotRig rig(seed, {}, {}, {}, Hall());
    rig.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{8, 0, 0}}, .leeway = {{0.3, 0.3}}});
    FastestBeside(rig, 6, -9, 0.8, 10);
    FastestBeside(rig, 3, 30, 1.2, 33);
    EXPECT_EQ(rig.state().mode, DriveMode::kArrived) << seed;
  }
}

}  // namespace
}  // namespace priamos::robot
