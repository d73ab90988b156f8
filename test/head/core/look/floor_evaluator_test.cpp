#include "head/core/look/floor_evaluator.hpp"

#include <gtest/gtest.h>

#include "test/support/laser_floor.hpp"

namespace priamos::head {
namespace {

class FloorEvaluatorTest : public testing::Test {
 protected:
  FloorEvaluatorTest() {
    setting_.tilt_rad = 0.62;
    scene_.camera = *head_.CameraAt(setting_, kThird);
  }
  /// The camera and the laser of NominalLaserFloor as a calibrated head.
  static HeadModel HeadWithLaser() {
    HeadModel head;
    head.lenses[kThird] = LensTable({0}, {0}, {LensState{.focal_px = 900, .k1 = -0.05, .pupil_m = 0.02}});
    head.lasers = support::NominalLaserFloor().lasers;
    return head;
  }
  /// Picture of a box `height_m` high 2 m ahead; negative: a pit.
  GreyImage Picture(double height_m) {
    scene_.steps.clear();
    if (height_m != 0) scene_.steps = {{1.9, 2.4, -0.1, 0.25, height_m, 0.8}};
    return support::Render(scene_, rng_);
  }
  std::optional<FloorResult> Evaluate(double height_m) { return dut_.Evaluate(Picture(height_m), setting_); }

  Rng rng_{11};
  HeadModel head_ = HeadWithLaser();
  HeadSetting setting_;
  support::LaserFloor scene_ = support::NominalLaserFloor();
  FloorEvaluator dut_{head_, ObstacleOptions()};
};

TEST_F(FloorEvaluatorTest, APlainFloorIsClear) {
  const auto dut = Evaluate(0);
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->lines.verdict, ObstacleLines::kClear);
  EXPECT_FALSE(dut->new_obstacle);
}

TEST_F(FloorEvaluatorTest, AnObstacleIsNewOnceAndAgainAfterAClearFloor) {
  const auto first = Evaluate(0.03);
  ASSERT_TRUE(first);
  ASSERT_TRUE(first->new_obstacle);
  EXPECT_NEAR(first->new_obstacle->height_m, 0.03, 0.01);
  EXPECT_NEAR(first->new_obstacle->left.x(), 2.0, 0.15);
  const auto second = Evaluate(0.03);
  EXPECT_EQ(second->lines.verdict, ObstacleLines::kObstacle);
  EXPECT_FALSE(second->new_obstacle);
  Evaluate(0);
  EXPECT_TRUE(Evaluate(0.03)->new_obstacle);
}

TEST_F(FloorEvaluatorTest, ALostPictureSaysNothingAndForgetsNothing) {
  Evaluate(0.03);
  EXPECT_FALSE(dut_.Evaluate(std::nullopt, setting_));
  EXPECT_FALSE(Evaluate(0.03)->new_obstacle);
}

/// A lamp that went out, or the calibration of another laser: said once, and again after it came back.
TEST_F(FloorEvaluatorTest, LinesThatAreNotSeenForLongAreLost) {
  const ImageSize size;
  const GreyImage dark{size.width, size.height,
                       std::vector<std::uint8_t>(std::size_t(size.width) * std::size_t(size.height))};
  int lost = 0;
  const auto look_at_dark = [&](int times) {
    for (int i = 0; i < times; ++i) lost += dut_.Evaluate(dark, setting_)->lines_lost ? 1 : 0;
  };
  look_at_dark(FloorEvaluator::kLostAfter - 1);
  EXPECT_EQ(lost, 0);
  look_at_dark(FloorEvaluator::kLostAfter);
  EXPECT_EQ(lost, 1);
  EXPECT_FALSE(Evaluate(0)->lines_lost);
  look_at_dark(FloorEvaluator::kLostAfter);
  EXPECT_EQ(lost, 2);
}

TEST_F(FloorEvaluatorTest, WithoutACalibratedLaserOrCameraNothingIsSaid) {
  HeadModel without_camera = head_;
  head_.lasers.clear();
  EXPECT_FALSE(FloorEvaluator(head_, {}).Evaluate(Picture(0.03), setting_));
  without_camera.lenses[kThird] = LensTable();
  EXPECT_FALSE(FloorEvaluator(without_camera, {}).Evaluate(Picture(0.03), setting_));
}

TEST(WorstPieceTest, IsTheOneFarthestFromTheFloorAboveOrBelow) {
  ObstacleLines lines;
  EXPECT_FALSE(WorstPiece(lines));
  for (const double height : {0.03, -0.05, 0.04}) {
    lines.pieces.emplace_back();
    lines.pieces.back().height_m = height;
  }
  EXPECT_EQ(WorstPiece(lines)->height_m, -0.05);
}

TEST(DescribePieceTest, SaysHowFarAheadAndHowHigh) {
  ObstaclePiece piece;
  piece.left = {1.96, 0.2, 0.03};
  piece.height_m = 0.031;
  EXPECT_EQ(Describe(piece), "obstacle 2.0 m ahead, +0.031 m against the floor");
  piece.height_m = -0.05;
  EXPECT_EQ(Describe(piece), "obstacle 2.0 m ahead, -0.050 m against the floor");
}

}  // namespace
}  // namespace priamos::head
