#include "robot/core/motion/back_off.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "robot/core/motion/path_follower.hpp"

namespace priamos::robot {
namespace {

constexpr Leeway kAside{1.5, 1.5};

Path Ahead() {
  return {.id = 1, .speed_m_s = 0.3, .points = {{6, 0, 0}}, .leeway = {kAside}};
}

PathShape ShapeAhead() {
  return {PathShapeConfig{}, {}, Ahead()};
}

/// Points along a straight line, 5 cm apart.
void AddLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::vector<Eigen::Vector2d>& points) {
  const int steps = static_cast<int>((to - from).norm() / 0.05);
  for (int k = 0; k <= steps; ++k) points.emplace_back(from + (to - from) * (double(k) / steps));
}

/// A pocket 1.1 m wide around the path from x = 1.4 on, shut at x = 2.6; free to the left of its left wall.
std::vector<Eigen::Vector2d> Pocket() {
  std::vector<Eigen::Vector2d> points;
  AddLine({1.4, 0.5}, {2.6, 0.5}, points);
  AddLine({2.6, 0.5}, {2.6, -2.5}, points);
  AddLine({1.4, -0.5}, {1.4, -2.5}, points);
  return points;
}

DrivenWay DrivenTo(double s) {
  DrivenWay driven;
  for (double at = 0; at <= s + 1e-9; at += 0.06) driven.Note({at, 0});
  return driven;
}

TEST(BackOff, LeadsOutOfAPocketOverWhatWasDriven) {
  const PathPlace here{1.92, 0};
  const auto ahead = FindDetour({}, {}, ShapeAhead(), here, Pocket(), {});
  ASSERT_TRUE(ahead);
  EXPECT_FALSE(ahead->leads_on());
  const auto other = FindOtherWay({}, {}, ShapeAhead(), here, Pocket(), DrivenTo(here.s));
  ASSERT_TRUE(other);
  EXPECT_EQ(other->taken, Things::kAsHeard);
  EXPECT_LT(other->back_to_m, 0.95) << "so that the base is before the pocket";
  EXPECT_GT(other->onward.At(2.6), 0.85) << "and goes on beside it";
}

TEST(BackOff, GoesBackOverNothingThatWasNotDriven) {
  EXPECT_FALSE(FindOtherWay({}, {}, ShapeAhead(), {1.92, 0}, Pocket(), DrivenWay()));
}

TEST(BackOff, GoesAsFarBackAsAnotherWayIsLongerAndNoFarther) {
  // The same pocket, 2 m deeper: the way beside it branches off before it.
  std::vector<Eigen::Vector2d> deep = Pocket();
  AddLine({1.4, 0.5}, {4.6, 0.5}, deep);
  AddLine({1.4, -0.5}, {4.6, -0.5}, deep);
  AddLine({4.6, 0.5}, {4.6, -0.5}, deep);
  std::erase_if(
      deep, [](const Eigen::Vector2d& p) { return std::abs(p.x() - 2.6) < 0.01 && std::abs(p.y()) < 0.45; });
  const PathPlace here{3.9, 0};
  const PathShape shape(PathShapeConfig{}, {},
                        {.id = 1, .speed_m_s = 0.3, .points = {{8, 0, 0}}, .leeway = {kAside}});
  const auto other = FindOtherWay({}, {}, shape, here, deep, DrivenTo(here.s));
  ASSERT_TRUE(other);
  EXPECT_LT(other->back_to_m, 0.95);
  EXPECT_GT(other->back_to_m, 0.05) << "not to where it began";
  EXPECT_NEAR(other->back.At(2.5), 0, 1e-9) << "over what it drove";
  EXPECT_GT(other->onward.At(4), 0.85);
}

TEST(BackOff, TakesThingsAsSmallerOnlyWhereNoOtherWayLeadsOn) {
  // A gap of 0.74 m in a wall: 8 cm less than a base with its margins needs.
  std::vector<Eigen::Vector2d> wall;
  AddLine({1.4, 0.37}, {1.4, 2.5}, wall);
  AddLine({1.4, -0.37}, {1.4, -2.5}, wall);
  const PathPlace here{0.72, 0};
  EXPECT_FALSE(FindOtherWay({}, {}, ShapeAhead(), here, wall, DrivenTo(here.s)));
  const auto other = FindOtherWay({}, {}, ShapeAhead(), here, wall, DrivenTo(here.s), Things::kSmaller, true);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->taken, Things::kSmaller);
  EXPECT_NEAR(other->back_to_m, here.s, 1e-9);
  // What is heard as 20 cm too narrow is closed.
  for (Eigen::Vector2d& point : wall) point.y() -= point.y() > 0 ? 0.1 : -0.1;
  EXPECT_FALSE(FindOtherWay({}, {}, ShapeAhead(), here, wall, DrivenTo(here.s), Things::kSmaller, true));
}

TEST(BackOff, KnowsWhereItDroveBetweenTwoNotesButNotBeyond) {
  DrivenWay driven;
  driven.Note({0.50, 0.1});
  driven.Note({0.60, 0.3});
  driven.Note({1.50, 0.3});
  EXPECT_NEAR(driven.At(0.55).value_or(9), 0.2, 1e-9);
  EXPECT_FALSE(driven.At(1.0));
  EXPECT_FALSE(driven.At(0.3));
  EXPECT_FALSE(driven.At(1.8));
}

/// The base after a step as wanted; it stays where that would take it nearer than 6 cm to a thing.
Pose2 Moved(const Pose2& pose, const Twist2& twist, double step_s,
            const std::vector<Eigen::Vector2d>& things) {
  const Pose2 next = Integrate(pose, twist, step_s);
  const bool free = std::none_of(things.begin(), things.end(), [&](const Eigen::Vector2d& thing) {
    const double gap_m = Footprint{}.Distance(next.Inverse() * thing);
    return gap_m < 0.06 && gap_m < Footprint{}.Distance(pose.Inverse() * thing);
  });
  return free ? next : pose;
}

/// A follower, with a base that does what it wants, for `seconds`; the farthest back that it went after it
/// had been farthest ahead [m], and where it is.
struct Outcome {
  double went_back_m = 0;
  Pose2 pose;
};

Outcome DrivenFor(double seconds, const std::vector<Eigen::Vector2d>& things) {
  constexpr double kStep_s = 0.02;
  PathFollower follower{PathFollowerConfig{}};
  follower.Follow(Ahead(), {});
  Outcome outcome;
  double farthest_m = 0;
  Time now = FromUtime(1'000'000);
  for (double t = 0; t < seconds; t += kStep_s, now += FromSeconds(kStep_s)) {
    follower.Avoid(things, now);
    const Twist2 twist = follower.Step(outcome.pose, {}, 0, kStep_s).twist;
    outcome.pose = Moved(outcome.pose, twist, kStep_s, things);
    farthest_m = std::max(farthest_m, outcome.pose.x);
    outcome.went_back_m = std::max(outcome.went_back_m, farthest_m - outcome.pose.x);
  }
  return outcome;
}

TEST(BackOff, ABaseThatWasToldOfAPocketTooLateComesOutOfItAndTurnsAside) {
  // From inside it, where it was led by a path along which nothing had been heard.
  constexpr double kStep_s = 0.02;
  PathFollower follower{PathFollowerConfig{}};
  follower.Follow(Ahead(), {});
  Pose2 pose;
  Time now = FromUtime(1'000'000);
  double farthest_back_m = 9;
  for (double t = 0; t < 60; t += kStep_s, now += FromSeconds(kStep_s)) {
    const bool heard = pose.x > 1.5 || farthest_back_m < 9;
    if (heard) farthest_back_m = std::min(farthest_back_m, pose.x);
    const auto things = heard ? Pocket() : std::vector<Eigen::Vector2d>{};
    follower.Avoid(things, now);
    pose = Moved(pose, follower.Step(pose, {}, 0, kStep_s).twist, kStep_s, things);
  }
  EXPECT_LT(farthest_back_m, 1.0);
  EXPECT_GT(pose.x, 5.9) << "it arrives on the free side, and does not go in again";
}

TEST(BackOff, ABaseDoesNotGoIntoADeadEndAgainThatItHearsNoMore) {
  // What closes the pocket is heard from inside it only.
  std::vector<Eigen::Vector2d> open = Pocket();
  std::erase_if(open, [](const Eigen::Vector2d& p) { return p.x() > 2.5 && std::abs(p.y()) < 0.49; });
  constexpr double kStep_s = 0.02;
  PathFollower follower{PathFollowerConfig{}};
  follower.Follow(Ahead(), {});
  Pose2 pose;
  Time now = FromUtime(1'000'000);
  int entered = 0;
  bool inside = false;
  for (double t = 0; t < 90; t += kStep_s, now += FromSeconds(kStep_s)) {
    const bool was_inside = inside;
    inside = pose.x > 1.3 && pose.y < 0.5;
    entered += inside && !was_inside;
    const auto things = inside ? Pocket() : open;
    follower.Avoid(things, now);
    pose = Moved(pose, follower.Step(pose, {}, 0, kStep_s).twist, kStep_s, Pocket());
  }
  EXPECT_EQ(entered, 1);
  EXPECT_GT(pose.x, 5.5) << "it arrives beside the pocket";
}

TEST(BackOff, BeforeAWallItStandsAndDoesNotGoToAndFro) {
  std::vector<Eigen::Vector2d> wall;
  AddLine({2.5, -3}, {2.5, 3}, wall);
  const Outcome outcome = DrivenFor(40, wall);
  EXPECT_LT(outcome.went_back_m, 0.1);
}

}  // namespace
}  // namespace priamos::robot
