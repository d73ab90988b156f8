#include "planner/core/locate/place_search.hpp"

#include <gmock/gmock.h>

#include "common/principal_axes.hpp"
#include "simulated_drive.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

GroundPlan Room(double x_m, double y_m) {
  GroundPlan plan;
  AddRoom(plan, {0, 0}, {x_m, y_m});
  return plan;
}

/// Of a stretch: anywhere on it.
bool IsAt(const PlaceCandidate& candidate, const Pose2& truth) {
  const double reach_m = 0.3 + (candidate.IsPoint() ? 0 : candidate.spread_m);
  return (candidate.map_from_base.translation() - truth.translation()).norm() < reach_m &&
         std::abs(WrapAngle(candidate.map_from_base.yaw - truth.yaw)) < Radians(6);
}

std::vector<PlaceCandidate> Find(const GroundPlan& plan, const SimulatedDrive& drive) {
  return FindPlaces({}, PlacePlan(plan), drive.way());
}

TEST(PlaceSearch, ARectangularRoomLeavesTwoPlacesHalfATurnApart) {
  const GroundPlan plan = Room(6, 4.4);
  Rng rng(3);
  SimulatedDrive drive(plan, {}, {2, 1.5, 0.4}, rng);
  drive.LookAround(8);
  const auto found = Find(plan, drive);
  ASSERT_EQ(found.size(), 2U);
  const Pose2 turned = Pose2{6, 4.4, kPi} * drive.truth();
  EXPECT_TRUE(IsAt(found[0], drive.truth()) || IsAt(found[1], drive.truth()));
  EXPECT_TRUE(IsAt(found[0], turned) || IsAt(found[1], turned));
  EXPECT_TRUE(found[0].IsPoint());
}

TEST(PlaceSearch, TwinRoomsHaveTwiceAsManyPlaces) {
  GroundPlan plan = Room(6, 4.4);
  AddRoom(plan, {6.14, 0}, {6, 4.4});
  Rng rng(3);
  SimulatedDrive drive(plan, {}, {2, 1.5, 0.4}, rng);
  drive.LookAround(8);
  const auto found = Find(plan, drive);
  ASSERT_GE(found.size(), 4U);
  EXPECT_NEAR(found[3].score, found[0].score, 0.1);
  // What a wall of the plan would have hidden is taken for an echo of an echo in other places.
  for (std::size_t i = 4; i < found.size(); ++i) EXPECT_LT(found[i].score, found[0].score - 3);
}

TEST(PlaceSearch, ARecessTellsTheEndsOfARoomApart) {
  GroundPlan plan = Room(6, 4.4);
  plan.walls.push_back(WallBetween(4.4, 0, 4.4, 1.6));
  plan.walls.push_back(WallBetween(4.4, 1.6, 6, 1.6));
  Rng rng(4);
  SimulatedDrive drive(plan, {}, {2, 1.5, 0.4}, rng);
  drive.LookAround(12);
  const auto found = Find(plan, drive);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(IsAt(found[0], drive.truth()));
  EXPECT_LT(PositionSigma(found[0].covariance), 0.15);
}

TEST(PlaceSearch, OneWallAloneSaysNothing) {
  const GroundPlan plan = Room(6, 4.4);
  Rng rng(5);
  SimulatedDrive drive(plan, {}, {2, 1.2, 0}, rng);
  ASSERT_TRUE(drive.Drive(drive.way_from_map() * Pose2{4, 1.2, 0}));
  for (const PlaceCandidate& candidate : Find(plan, drive)) EXPECT_FALSE(candidate.IsPoint());
}

TEST(PlaceSearch, ALongCorridorIsNotOnePlace) {
  const GroundPlan plan = Room(30, 2.2);
  Rng rng(6);
  SimulatedDrive drive(plan, {}, {12, 1.1, 0}, rng);
  ASSERT_TRUE(drive.Drive(drive.way_from_map() * Pose2{16, 1.1, 0}));
  for (const PlaceCandidate& candidate : Find(plan, drive)) EXPECT_FALSE(candidate.IsPoint());
}

TEST(PlaceSearch, AThingThatIsNotOnThePlanLeavesTheTrueOneAmongThePlaces) {
  const GroundPlan plan = Room(6, 4.4);
  for (int seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    const Rectangle cupboard{{rng.Uniform(1, 5), 4.2, 0}, {0.6, 0.2}};
    const Rectangle carton{{rng.Uniform(0.6, 5.4), 0.4, 0.2}, {0.4, 0.4}};
    SimulatedDrive drive(plan, {cupboard, carton}, {2.5, 2.2, rng.Uniform(-3, 3)}, rng);
    drive.LookAround(8);
    const auto found = Find(plan, drive);
    if (found.empty()) continue;
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const PlaceCandidate& c) {
      return IsAt(c, drive.truth());
    })) << seed;
  }
}

TEST(PlaceSearch, NothingHeardIsNoPlace) {
  Rng rng(1);
  const GroundPlan plan = Room(6, 4.4);
  EXPECT_TRUE(Find(plan, SimulatedDrive(plan, {}, {2, 2, 0}, rng)).empty());
}

}  // namespace
}  // namespace priamos::planner
