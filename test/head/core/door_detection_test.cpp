#include "head/core/door_detection.hpp"

#include <gtest/gtest.h>

#include "head/core/edge_segments.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

class DoorDetectionTest : public testing::Test {
 protected:
  std::vector<DetectedDoor> Detect(const std::vector<test::Quad>& quads, const Pose2& base_from_scene) {
    EdgeOperator op;
    op.Extract(test::RenderQuads(quads, Lift(base_from_scene), left_, 2, rng_), edges_[0]);
    op.Extract(test::RenderQuads(quads, Lift(base_from_scene), right_, 2, rng_), edges_[1]);
    return DetectDoors(MakeView(left_, edges_[0]), MakeView(right_, edges_[1]), {});
  }

  Rng rng_{5};
  const CameraModel left_ = test::HeadCamera(0, 1, 700), right_ = test::HeadCamera(0, -1, 700);
  EdgeImage edges_[2];
};

TEST_F(DoorDetectionTest, FindsTheDoorThatNoMapToldOf) {
  const Pose2 truth{3.2, 0.1, 0.05};
  const auto dut = Detect(test::DoorQuads(), truth);
  ASSERT_EQ(dut.size(), 1u);
  const Eigen::Vector2d front = truth * Eigen::Vector2d(-0.085, 0);
  EXPECT_LT((dut[0].base_from_door.translation() - front).norm(), 0.03);
  EXPECT_NEAR(dut[0].base_from_door.yaw, truth.yaw, 0.04);
  EXPECT_NEAR(dut[0].height_m, 2.03, 0.05);
  EXPECT_NEAR(dut[0].width_m, 0.96, 0.08);
}

TEST_F(DoorDetectionTest, AWallHasNoDoor) {
  EXPECT_TRUE(Detect(test::WallQuads(), {3.2, 0.1, 0.05}).empty());
}

TEST_F(DoorDetectionTest, ABoardThatHangsOnTheWallIsNoDoor) {
  auto quads = test::WallQuads();
  quads.push_back({{-0.08, -0.45, 0.7}, {0, 0.9, 0}, {0, 0, 1.3}, 60});  // as wide, and its top as high
  EXPECT_TRUE(Detect(quads, {3.2, 0.1, 0.05}).empty());
}

TEST_F(DoorDetectionTest, ACupboardIsTooLow) {
  auto quads = test::WallQuads();
  quads.push_back({{-0.5, -0.45, 0}, {0, 0.9, 0}, {0, 0, 1.6}, 60});
  EXPECT_TRUE(Detect(quads, {3.2, 0.1, 0.05}).empty());
}

TEST_F(DoorDetectionTest, ExchangedImagesShowNoDoor) {
  Detect(test::DoorQuads(), {3.2, 0.1, 0.05});
  EXPECT_TRUE(DetectDoors(MakeView(left_, edges_[1]), MakeView(right_, edges_[0]), {}).empty());
}

}  // namespace
}  // namespace priamos::head
