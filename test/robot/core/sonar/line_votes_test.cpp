#include "robot/core/sonar/line_votes.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace priamos::robot {
namespace {

/// What a sensor at (x, y) hears of the line n * p = distance when it looks `off_rad` beside its normal.
PlacedEcho Echo(const Eigen::Vector2d& at, double angle_rad, double distance_m, double off_rad = 0) {
  const Eigen::Vector2d normal(std::cos(angle_rad), std::sin(angle_rad));
  return {{}, {at.x(), at.y(), angle_rad + off_rad}, distance_m - normal.dot(at), 0};
}

RC_GTEST_PROP(LineVotes, TheLineOfAllEchoesHasMostVotes, ()) {
  const double angle = Radians(*rc::gen::inRange(-1800, 1801) / 10.0);
  const double distance = *rc::gen::inRange(-500, 500) / 10.0;
  const Eigen::Vector2d normal(std::cos(angle), std::sin(angle)), along(-normal.y(), normal.x());
  LineVotes dut;
  PlacedEcho last;
  for (int i = 0; i < 20; ++i)
    dut.Add(last = Echo(normal * (distance - 1) + along * (0.05 * i), angle, distance,
                        Radians(*rc::gen::inRange(-6, 7))));
  const VotedLine best = dut.Best(last);
  RC_ASSERT(best.votes >= 18);
  RC_ASSERT(std::abs(WrapAngle(best.angle_rad - angle)) < Radians(8));
}

RC_GTEST_PROP(LineVotes, WhatIsRemovedCountsNoMore, ()) {
  LineVotes dut;
  const PlacedEcho one =
      Echo({*rc::gen::inRange(-500, 500) / 10.0, *rc::gen::inRange(-500, 500) / 10.0}, 1, 3);
  dut.Add(one);
  dut.Add(Echo({20, 20}, -2, 40));
  RC_ASSERT(dut.Best(one).votes >= 1);
  dut.Remove(one);
  RC_ASSERT(dut.Best(one).votes <= 1);
}

TEST(LineVotes, APointIsNotALine) {
  LineVotes dut;
  PlacedEcho last;
  const Eigen::Vector2d post(2, 0);
  for (double y = -0.6; y < 0.6; y += 0.05) {
    const Eigen::Vector2d to_post = post - Eigen::Vector2d(0, y);
    dut.Add(last = {{}, {0, y, std::atan2(to_post.y(), to_post.x())}, to_post.norm(), 0});
  }
  EXPECT_LT(dut.Best(last).votes, 24) << "its arcs touch many lines, each only for a while";
}

}  // namespace
}  // namespace priamos::robot
