#include "robot/core/pose/plan_match.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "common/random.hpp"

namespace priamos::robot {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

const PlanMatchConfig kConfig;
/// A corridor along x, 2 m wide: on the way along a face it is to the right.
const PlanWall kNorth{{20, 1}, {-2, 1}, 0.02}, kSouth{{-2, -1}, {20, -1}, 0.02};
const std::bitset<PoseState::kMostWalls> kAllHeard{0b1111};

/// Believed to be at (5, y), one sigma as given.
PoseState At(double y_m, double sigma_m, double sigma_yaw_rad) {
  PoseState state;
  state.mean.head<3>() << 5, y_m, 0;
  PoseState::Vector sigma(PoseState::kOwn);
  sigma << sigma_m, sigma_m, sigma_yaw_rad, 0.004, 0.015, 0.008, 0.004, 0.0025, 0.006, 0.01, 0.006;
  state.covariance = sigma.cwiseAbs2().asDiagonal();
  return state;
}

WallSeen Seen(double bearing_rad, double distance_m) {
  return {bearing_rad, distance_m, Eigen::Vector2d(1e-4, 2.5e-5).asDiagonal()};
}
const double kLeft = kPi / 2, kRight = -kPi / 2;

TEST(PlanMatch, TwoWallsAsFarApartAsOnThePlanAreThePlans) {
  // It truly is at y = 0, and turned by 0.05.
  PoseState state = At(0.15, 0.115, 0.06);
  state = WithWall(WithWall(state, Seen(kLeft - 0.05, 1)), Seen(kRight - 0.05, 1));
  const auto matches = MatchPlan(state, kAllHeard, {kNorth, kSouth}, kConfig);
  ASSERT_THAT(matches, SizeIs(2));
  EXPECT_EQ(matches[0].plan.from, kNorth.from);
  for (const PlanMatch& match : matches) state = Updated(state, match);
  EXPECT_NEAR(state.pose().y, 0, 0.01);
  EXPECT_NEAR(state.pose().yaw, 0.05, 0.01);
  EXPECT_LT(std::sqrt(state.covariance(1, 1)), 0.03);
  EXPECT_LT(std::sqrt(state.covariance(2, 2)), Radians(0.8));
  EXPECT_NEAR(std::sqrt(state.covariance(0, 0)), 0.115, 0.002) << "a wall tells nothing along itself";
}

TEST(PlanMatch, AThingBeforeAWallIsNotTakenForIt) {
  // A cupboard of 30 cm before the left wall, by a pose that is known to 11 cm only.
  const PoseState one = WithWall(At(0, 0.115, 0.05), Seen(kLeft, 0.7));
  EXPECT_THAT(MatchPlan(one, kAllHeard, {kNorth, kSouth}, kConfig), IsEmpty());
  const PoseState both = WithWall(one, Seen(kRight, 1));
  EXPECT_THAT(MatchPlan(both, kAllHeard, {kNorth, kSouth}, kConfig), IsEmpty());
}

TEST(PlanMatch, AKnownPoseNeedsOneWallOnly) {
  const PoseState known = WithWall(At(0.03, 0.03, 0.01), Seen(kLeft, 1));
  EXPECT_THAT(MatchPlan(known, kAllHeard, {kNorth, kSouth}, kConfig), SizeIs(1));
  const PoseState unknown = WithWall(At(0.03, 0.115, 0.01), Seen(kLeft, 1));
  EXPECT_THAT(MatchPlan(unknown, kAllHeard, {kNorth, kSouth}, kConfig), IsEmpty());
}

TEST(PlanMatch, AmbiguousOrUnheardOrBesideTheWallsEndIsNone) {
  const PoseState state = WithWall(At(0, 0.03, 0.01), Seen(kLeft, 1));
  const PlanWall near{{20, 1.1}, {-2, 1.1}, 0.02}, elsewhere{{20, 1}, {8, 1}, 0.02},
      other_face{{-2, 1}, {20, 1}, 0.02};
  EXPECT_THAT(MatchPlan(state, kAllHeard, {kNorth, near}, kConfig), IsEmpty());
  EXPECT_THAT(MatchPlan(state, {}, {kNorth}, kConfig), IsEmpty());
  EXPECT_THAT(MatchPlan(state, kAllHeard, {elsewhere}, kConfig), IsEmpty());
  EXPECT_THAT(MatchPlan(state, kAllHeard, {other_face}, kConfig), IsEmpty());
  EXPECT_THAT(MatchPlan(state, kAllHeard, {}, kConfig), IsEmpty());
}

TEST(PlanMatch, TheSameWallCountsOnce) {
  PoseState state = WithWall(At(0.02, 0.04, 0.01), Seen(kLeft, 1));
  const PlanMatch match{0, kNorth};
  for (int i = 0; i < 200; ++i) state = Updated(state, match);
  // At the foot of x = 5 the two ends of the plan's wall have these weights.
  const double foot = 15.0 / 22, plan_m = 0.02 * std::hypot(1 - foot, foot);
  EXPECT_GT(std::sqrt(state.covariance(1, 1)), 0.95 * plan_m);
}

TEST(PlanMatch, ThePlansErrorIsThatOfItsEnds) {
  // The pose is known as the plan knows the wall beside it: at an end sigma, in the middle less.
  for (const auto& [x_m, expected_m] : {std::pair{-2.0, 0.02}, {9.0, 0.02 / std::sqrt(2)}, {20.0, 0.02}}) {
    PoseState state = At(0, 2, 0.3);
    state.mean(0) = x_m;
    state = WithWall(state, {kLeft, 1, Eigen::Vector2d(1e-10, 1e-10).asDiagonal()});
    const PoseState dut = Updated(state, {0, kNorth});
    EXPECT_NEAR(std::sqrt(dut.covariance(1, 1)), expected_m, 3e-4) << x_m;
  }
}

/// Normalised error squared of what walls tell (across, heading), with errors drawn as claimed.
TEST(PlanMatch, TheCovarianceIsHonest) {
  constexpr int kRuns = 600;
  double nees = 0;
  int n = 0;
  for (int run = 0; run < kRuns; ++run) {
    Rng rng = Rng::Stream(static_cast<std::uint64_t>(run), "plan match");
    const auto planned = [&](PlanWall wall) {
      wall.from.y() += rng.Normal(wall.sigma_m);
      wall.to.y() += rng.Normal(wall.sigma_m);
      return wall;
    };
    const std::vector<PlanWall> plan{planned(kNorth), planned(kSouth)};
    PoseState state = At(0, 0.1, 0.04);
    const double true_y = rng.Normal(0.1), true_yaw = rng.Normal(0.04);
    const auto seen = [&](double bearing_rad, double distance_m) {
      return Seen(bearing_rad - true_yaw + rng.Normal(1e-2), distance_m + rng.Normal(5e-3));
    };
    state = WithWall(WithWall(state, seen(kLeft, 1 - true_y)), seen(kRight, 1 + true_y));
    const auto matches = MatchPlan(state, kAllHeard, plan, kConfig);
    if (matches.empty()) continue;
    for (const PlanMatch& match : matches) state = Updated(state, match);
    const Eigen::Vector2d error(state.mean(1) - true_y, state.mean(2) - true_yaw);
    nees += error.dot(state.covariance.block<2, 2>(1, 1).inverse() * error);
    ++n;
  }
  EXPECT_GT(n, 0.9 * kRuns);
  EXPECT_GT(nees / n, 1.2) << "2 is right; what may be correlated is not averaged";
  EXPECT_LT(nees / n, 2.2);
}

RC_GTEST_PROP(PlanMatch, NeverTakesAThingOfDepthForAWall, (std::uint64_t seed)) {
  Rng rng(seed);
  // Known as at the start of a drive; a thing of 25 cm and deeper stands before one of the walls.
  PoseState state = At(rng.Uniform(-0.2, 0.2), 0.115, 0.05);
  const double depth_m = rng.Uniform(0.25, 0.6), turn = rng.Uniform(-0.08, 0.08);
  state = WithWall(state, Seen(kLeft + turn, 1 - depth_m + rng.Normal(0.005)));
  if (rng.Chance(0.7)) state = WithWall(state, Seen(kRight + turn, 1 + rng.Normal(0.005)));
  RC_ASSERT(MatchPlan(state, kAllHeard, {kNorth, kSouth}, kConfig).empty());
}

}  // namespace
}  // namespace priamos::robot
