#include "head/core/floor/obstacle_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "head/core/camera/head_model.hpp"
#include "test/support/laser_floor.hpp"
namespace priamos::head {
namespace {

using support::FloorStep;
using support::LaserFloor;

class ObstacleLinesTest : public testing::Test {
 protected:
  ObstacleLines Look(const LaserFloor& scene) {
    return dut_.Find(support::Render(scene, rng_), scene.camera, scene.lasers);
  }
  static std::vector<ObstaclePiece> Of(const ObstacleLines& lines, ObstaclePiece::Kind kind) {
    std::vector<ObstaclePiece> pieces;
    std::copy_if(lines.pieces.begin(), lines.pieces.end(), std::back_inserter(pieces),
                 [&](const ObstaclePiece& p) { return p.kind == kind; });
    return pieces;
  }

  Rng rng_{11};
  ObstacleFinder dut_;
  LaserFloor scene_ = support::NominalLaserFloor();
};

TEST_F(ObstacleLinesTest, APlainFloorIsClearHoweverTheRobotNods) {
  for (int i = 0; i < 30; ++i) {
    LaserFloor scene = scene_;
    scene.heave_m = rng_.Normal(0.002), scene.pitch_rad = rng_.Normal(0.002),
    scene.roll_rad = rng_.Normal(0.002);
    const ObstacleLines lines = Look(scene);
    EXPECT_EQ(lines.verdict, ObstacleLines::kClear) << i;
    EXPECT_GT(lines.seen_share, 0.95);
    EXPECT_TRUE(lines.pieces.empty());
  }
}

TEST_F(ObstacleLinesTest, ABoxOfThreeCentimetresStandsUpWhereItStands) {
  scene_.steps = {{1.9, 2.4, -0.1, 0.25, 0.03, 0.8}};
  scene_.pitch_rad = 0.002;
  const ObstacleLines lines = Look(scene_);
  ASSERT_EQ(lines.verdict, ObstacleLines::kObstacle);
  const auto up = Of(lines, ObstaclePiece::kUp);
  ASSERT_EQ(up.size(), 1u);
  EXPECT_NEAR(up[0].right.y(), -0.1, 0.01);
  EXPECT_NEAR(up[0].left.y(), 0.25, 0.01);
  EXPECT_NEAR(up[0].height_m, 0.03, 3 * up[0].sigma_height_m);
  EXPECT_LT(up[0].sigma_height_m, 0.004);
  EXPECT_NEAR(up[0].right.x(), 0.46 + (0.60 - 0.03) / std::tan(0.35), 0.03);
}

TEST_F(ObstacleLinesTest, AStepDownOnOneSideIsTold) {
  scene_.steps = {{1.0, 6, -3, -0.2, -0.03}};
  const auto down = Of(Look(scene_), ObstaclePiece::kDown);
  ASSERT_EQ(down.size(), 1u);
  EXPECT_NEAR(down[0].height_m, -0.03, 3 * down[0].sigma_height_m);
  EXPECT_NEAR(down[0].left.y(), -0.2, 0.02);
}

TEST_F(ObstacleLinesTest, AStepDownAcrossAllOfTheLineIsTold) {
  scene_.steps = {{1.5, 8, -4, 4, -0.04}};
  const auto down = Of(Look(scene_), ObstaclePiece::kDown);
  ASSERT_FALSE(down.empty());
  EXPECT_NEAR(down[0].height_m, -0.04, 0.01);
}

TEST_F(ObstacleLinesTest, AStairwellIsDeepOrItsLineIsMissing) {
  for (const double depth : {0.17, 0.4, 2.5}) {
    LaserFloor scene = scene_;
    scene.steps = {{1.9, 8, -0.4, 0.4, -depth}};
    const ObstacleLines lines = Look(scene);
    const auto down = Of(lines, ObstaclePiece::kDown), missing = Of(lines, ObstaclePiece::kMissing);
    EXPECT_FALSE(down.empty() && missing.empty()) << depth;
    for (const ObstaclePiece& p : down) EXPECT_LT(p.height_m, -0.1) << depth;
  }
}

TEST_F(ObstacleLinesTest, WhatIsDrivenOverIsNotTold) {
  scene_.steps = {{1.9, 2.4, -0.1, 0.25, 0.008}};
  EXPECT_EQ(Look(scene_).verdict, ObstacleLines::kClear);
}

TEST_F(ObstacleLinesTest, ABlackPatchIsMissingWhereTheFloorWouldBe) {
  scene_.steps = {{1.5, 3, 0.2, 0.5, 0.0005, 0.0}};
  const ObstacleLines lines = Look(scene_);
  EXPECT_EQ(lines.verdict, ObstacleLines::kClear);
  const auto missing = Of(lines, ObstaclePiece::kMissing);
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_NEAR(missing[0].right.y(), 0.2, 0.03);
  EXPECT_NEAR(missing[0].left.y(), 0.5, 0.03);
  EXPECT_NEAR(missing[0].right.x(), 2.10, 0.03);
}

TEST_F(ObstacleLinesTest, WithoutLightItSaysThatItIsBlind) {
  scene_.amplitude = 0;
  EXPECT_EQ(Look(scene_).verdict, ObstacleLines::kBlind);
}

TEST_F(ObstacleLinesTest, ACameraThatLooksElsewhereIsBlind) {
  LaserFloor scene = scene_;
  HeadSetting level;
  level.tilt_rad = -0.1;
  const GreyImage picture = support::Render(scene, rng_);
  const CameraModel up = MakeCameraModel({900, {383.5, 287.5}, -0.05, 0, 0.02},
                                         HeadGeometry().BaseFromCamera(level, kThird, 0.02));
  EXPECT_EQ(dut_.Find(picture, up, scene.lasers).verdict, ObstacleLines::kBlind);
  const RowRange rows = LineRows(up, scene.lasers[0], {}, {});
  EXPECT_GT(rows.first, rows.last);
}

TEST_F(ObstacleLinesTest, TheHeightsErrorIsWhatItsSigmaSays) {
  double squares = 0;
  int n = 0;
  for (int i = 0; i < 40; ++i) {
    LaserFloor scene = scene_;
    scene.heave_m = rng_.Normal(0.002), scene.pitch_rad = rng_.Normal(0.002),
    scene.roll_rad = rng_.Normal(0.002);
    const double y = rng_.Uniform(-0.6, 0.3), height = rng_.Uniform(0.03, 0.06);
    scene.steps = {{1.8, 2.5, y, y + 0.25, height}};
    for (const ObstaclePiece& p : Of(Look(scene), ObstaclePiece::kUp)) {
      squares += std::pow((p.height_m - height) / p.sigma_height_m, 2);
      ++n;
    }
  }
  EXPECT_GE(n, 39);
  EXPECT_LT(squares / n, 2);
}

TEST_F(ObstacleLinesTest, NothingSensibleGivesNothingHarmful) {
  GreyImage white{768, 576, std::vector<std::uint8_t>(768 * 576, 255)};
  EXPECT_EQ(dut_.Find(white, scene_.camera, scene_.lasers).verdict, ObstacleLines::kBlind);
  EXPECT_EQ(FindObstacles({}, scene_.camera, {}).verdict, ObstacleLines::kBlind);
  const LaserPlane none{};
  EXPECT_EQ(dut_.Find(white, CameraModel{}, {&none, 1}).verdict, ObstacleLines::kBlind);
  EXPECT_EQ(dut_.Find(white, scene_.camera, {}).verdict, ObstacleLines::kBlind);
}

class TwoLinesTest : public ObstacleLinesTest {
 protected:
  TwoLinesTest() { scene_ = support::NominalLaserPair(); }
  void Nod() {
    scene_.heave_m = rng_.Normal(0.002);
    scene_.pitch_rad = rng_.Normal(0.002);
    scene_.roll_rad = rng_.Normal(0.002);
  }
};

TEST_F(TwoLinesTest, APlainFloorIsClearHoweverTheRobotNods) {
  for (int i = 0; i < 30; ++i) {
    Nod();
    const ObstacleLines lines = Look(scene_);
    EXPECT_EQ(lines.verdict, ObstacleLines::kClear) << i;
    EXPECT_GT(lines.seen_share, 0.95);
    EXPECT_TRUE(lines.pieces.empty());
  }
}

/// One line alone finds it in three of four pictures.
TEST_F(TwoLinesTest, AStepOfThreeCentimetresAcrossAllOfTheNearLineIsFoundHoweverTheRobotNods) {
  for (const double height : {0.03, -0.03}) {
    int found = 0;
    for (int i = 0; i < 40; ++i) {
      Nod();
      scene_.steps = {{1.8, 2.4, -4, 4, height}};
      for (const ObstaclePiece& p : Look(scene_).pieces)
        found += p.kind != ObstaclePiece::kMissing && p.laser == 0 && std::abs(p.height_m - height) < 0.008;
    }
    EXPECT_GE(found, 39) << height;
  }
}

TEST_F(TwoLinesTest, EachLineTellsWhatStandsOnIt) {
  scene_.steps = {{1.9, 2.3, -0.3, -0.1, 0.03}, {2.7, 3.2, 0.2, 0.5, 0.05}};
  const auto up = Of(Look(scene_), ObstaclePiece::kUp);
  ASSERT_EQ(up.size(), 2U);
  EXPECT_EQ(up[0].laser, 0);
  EXPECT_NEAR(up[0].height_m, 0.03, 3 * up[0].sigma_height_m);
  EXPECT_EQ(up[1].laser, 1);
  EXPECT_NEAR(up[1].height_m, 0.05, 3 * up[1].sigma_height_m);
  EXPECT_NEAR(up[1].right.x(), 0.46 + 0.55 / std::tan(std::atan2(0.6, 2.54)), 0.03);
}

/// A box that reaches from before the near line to the far one lifts both: told apart by their order.
TEST_F(TwoLinesTest, ATallBoxBeforeBothLinesShowsBothOnItsFront) {
  scene_.steps = {{1.9, 3.5, -0.2, 0.2, 0.5}};
  const auto up = Of(Look(scene_), ObstaclePiece::kUp);
  ASSERT_EQ(up.size(), 2U);
  for (const ObstaclePiece& p : up) {
    EXPECT_NEAR(p.right.x(), 1.9, 0.02);
    const double slope = p.laser == 0 ? std::tan(0.35) : 0.6 / 2.54;
    EXPECT_NEAR(p.height_m, 0.6 - slope * (1.9 - 0.46), 0.01);
  }
}

TEST_F(TwoLinesTest, ALineOutsideOfThePictureIsNotMissing) {
  scene_.camera = support::ThirdCamera(0.21);
  const ObstacleLines lines = Look(scene_);
  EXPECT_EQ(lines.verdict, ObstacleLines::kClear);
  EXPECT_GT(lines.seen_share, 0.95) << "of the far line";
  EXPECT_TRUE(lines.pieces.empty());
}

}  // namespace
}  // namespace priamos::head
