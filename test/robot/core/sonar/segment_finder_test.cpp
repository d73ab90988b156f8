#include "robot/core/sonar/segment_finder.hpp"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "test/robot/support/corridor_drive.hpp"

namespace priamos::robot {
namespace {

using testing::SizeIs;

const Surface kLeft{{-2, 1.1}, {30, 1.1}}, kRight{{-2, -0.9}, {30, -0.9}};

TEST(SegmentFinder, BothWallsOfACorridorAreFoundAndGrow) {
  CorridorDrive drive(1, {}, {kLeft, kRight});
  drive.Drive({0.3, 0, 0}, 6);
  ASSERT_THAT(drive.found(), SizeIs(2));
  const double length_m = drive.found().at(1).wall.length_m();
  EXPECT_GT(length_m, 1.2);
  drive.Drive({0.3, 0, 0}, 3);
  EXPECT_THAT(drive.found(), SizeIs(2)) << "a wall keeps its number";
  EXPECT_NEAR(drive.found().at(1).wall.length_m(), length_m + 0.9, 0.15);
}

TEST(SegmentFinder, ALongWallIsSeveralSegmentsWithoutGaps) {
  CorridorDrive drive(2, {}, {kLeft});
  drive.Drive({0.3, 0, 0}, 50);
  EXPECT_GE(drive.found().size(), 4u);
  double covered_m = 0;
  for (const auto& [number, found] : drive.found()) {
    EXPECT_LE(found.wall.length_m(), 4.1);
    covered_m += found.wall.length_m();
  }
  EXPECT_GT(covered_m, 13.5) << "of 15 m driven";
}

TEST(SegmentFinder, ABaseThatStandsFindsNothing) {
  CorridorDrive drive(3, {}, {kLeft, kRight});
  drive.Drive({}, 20);
  EXPECT_THAT(drive.found(), SizeIs(0));
}

TEST(SegmentFinder, ADoorwayLeavesAGap) {
  CorridorDrive drive(4, {}, {{{-2, 0.9}, {2.0, 0.9}}, {{3.0, 0.9}, {9, 0.9}}});
  drive.Drive({0.3, 0, 0}, 20);
  ASSERT_GE(drive.found().size(), 2u);
  const WallSegment &before = drive.found().at(1).wall, &behind = drive.found().at(2).wall;
  // Ends along the way; a beam hears an edge that it has passed, and does not hear one before it.
  const double end_m = std::max(before.from().x(), before.to().x());
  const double begin_m = std::min(behind.from().x(), behind.to().x());
  EXPECT_NEAR(end_m, 2.0, 3 * before.end_sigma_m());
  EXPECT_NEAR(begin_m, 3.0, 3 * behind.end_sigma_m());
}

TEST(SegmentFinder, WhatCanBeOfAnEdgeMakesNoWallLonger) {
  CorridorDrive drive(1, {}, {kLeft});
  drive.Drive({0.3, 0, 0}, 6);
  ASSERT_THAT(drive.found(), SizeIs(1));
  const double length_m = drive.found().at(1).wall.length_m();
  drive.of_point = [](const PlacedEcho&) { return true; };
  drive.Drive({0.3, 0, 0}, 1.5);
  EXPECT_NEAR(drive.found().at(1).wall.length_m(), length_m, 0.05);
}

TEST(SegmentFinder, ColumnsAndPostsAreNoWalls) {
  std::vector<Surface> posts;
  for (double x = 0; x < 10; x += 1.1)
    for (const double y : {-1.0, 1.2})
      for (const Surface& side : BoxSides(x, y - 0.05, x + 0.1, y + 0.05)) posts.push_back(side);
  for (int seed = 0; seed < 2; ++seed) {
    CorridorDrive drive(static_cast<std::uint64_t>(seed), {}, posts);
    drive.Drive({0.3, 0, 0}, 30);
    EXPECT_THAT(drive.found(), SizeIs(0)) << seed;
  }
}

TEST(SegmentFinder, FalseEchoesHideNoWallAndMakeNone) {
  CorridorDrive drive(5, {}, {kLeft});
  drive.sonars().SetFalseEchoes(0.1);
  drive.Drive({0.3, 0, 0}, 10);
  ASSERT_THAT(drive.found(), SizeIs(1));
  EXPECT_NEAR(drive.ErrorOf(drive.found().at(1), kLeft).y(), 0, 0.03);
}

TEST(SegmentFinder, AWallThatIsMetAheadIsFoundWhileTheBaseTurns) {
  CorridorDrive drive(6, {}, {{{2.2, -3}, {2.2, 3}}});
  drive.Drive({0.2, 0, 0}, 2);
  drive.Drive({0, 0.2, 0}, 6);
  ASSERT_GE(drive.found().size(), 1u);
  EXPECT_NEAR(drive.ErrorOf(drive.found().at(1), {{2.2, -3}, {2.2, 3}}).y(), 0, 0.05);
}

TEST(SegmentFinder, NumbersOutOfRangeAreNoEchoes) {
  SegmentFinder dut({}, {}, {});
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), 1e200, -1.0, 0.1, 5.001}) {
    for (int i = 0; i < 100; ++i) {
      SonarCycle cycle{FromUtime(1'000'000 + i * 100'000), {}};
      cycle.range_m.fill(value);
      EXPECT_TRUE(dut.Add(cycle, {0.03 * i, 0, 0}).empty());
    }
  }
}

/// Normalised estimation error squared per degree of freedom, one sample per corridor: width, heading, noise
/// of the wheels and of the sonars are drawn anew.
TEST(SegmentFinder, TheCovarianceIsHonest) {
  constexpr int kRuns = 150;
  double nees = 0;
  int found = 0;
  for (int seed = 0; seed < kRuns; ++seed) {
    Rng rng(static_cast<std::uint64_t>(1000 + seed));
    const Surface wall{{-3, rng.Uniform(0.7, 1.6)}, {12, rng.Uniform(0.7, 1.6)}};
    CorridorDrive drive(static_cast<std::uint64_t>(seed), {0, 0, rng.Uniform(-0.06, 0.06)}, {wall});
    drive.Drive({rng.Uniform(0.2, 0.5), 0, rng.Uniform(-0.02, 0.02)}, rng.Uniform(6, 14));
    if (drive.found().empty()) continue;
    const FoundSegment& dut = drive.found().begin()->second;
    const Eigen::Vector2d error = drive.ErrorOf(dut, wall);
    nees += error.dot(CorridorDrive::CovarianceOf(dut).inverse() * error) / 2;
    ++found;
  }
  EXPECT_GT(found, 0.95 * kRuns);
  EXPECT_GT(nees / found, 0.8);
  EXPECT_LT(nees / found, 1.2);
}

}  // namespace
}  // namespace priamos::robot
