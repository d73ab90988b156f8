#include "head/core/doors/door_detection.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "head/core/edges/edge_segments.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

class DoorDetectionTest : public testing::Test {
 protected:
  std::vector<DetectedDoor> Detect(const std::vector<test::Quad>& quads, const Pose2& base_from_scene) {
    EdgeOperator op(DoorEdges());
    op.Extract(test::RenderQuads(quads, Lift(base_from_scene), left_, 2, rng_), edges_[0]);
    op.Extract(test::RenderQuads(quads, Lift(base_from_scene), right_, 2, rng_), edges_[1]);
    return DetectDoors(MakeView(left_, edges_[0]), MakeView(right_, edges_[1]), {});
  }

  Rng rng_{5};
  const CameraModel left_ = test::HeadCamera(0, 1, 700), right_ = test::HeadCamera(0, -1, 700);
  EdgeImage edges_[2];
};

/// Quads moved to another place.
std::vector<test::Quad> Moved(std::vector<test::Quad> quads, const Pose2& there) {
  const Eigen::Isometry3d motion = Lift(there);
  for (test::Quad& q : quads) {
    q.corner = motion * q.corner;
    q.u = motion.linear() * q.u;
    q.v = motion.linear() * q.v;
  }
  return quads;
}

void Append(std::vector<test::Quad>& all, const std::vector<test::Quad>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Along x: a door in the left wall, another one at the end, notice boards on the right.
std::vector<test::Quad> CorridorQuads(const Pose2& left_door, const Pose2& end_door) {
  auto right = test::WallQuads();
  right.push_back({{-0.08, -1.2, 0.9}, {0, 0.9, 0}, {0, 0, 1.0}, 90});
  right.push_back({{-0.08, 0.2, 0.4}, {0, 0.9, 0}, {0, 0, 1.6}, 120});
  std::vector<test::Quad> all;
  for (const auto& [quads, there] :
       {std::pair(test::DoorQuads(0.8), left_door), std::pair(test::DoorQuads(), end_door),
        std::pair(right, Pose2{4.0, -1.4, -kPi / 2})})
    Append(all, Moved(quads, there));
  return all;
}

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

TEST_F(DoorDetectionTest, APanelWithoutAFrameIsNoDoor) {
  auto quads = test::WallQuads();
  quads.push_back({{-0.08, -0.45, 0}, {0, 0.9, 0}, {0, 0, 2.05}, 90});
  EXPECT_TRUE(Detect(quads, {3.2, 0.1, 0.05}).empty());
}

TEST_F(DoorDetectionTest, ALowerLintelIsNotADoors) {
  auto quads = test::DoorQuads();
  for (test::Quad& q : quads) {
    q.corner.z() *= 0.8;
    q.u.z() *= 0.8;
    q.v.z() *= 0.8;
  }
  EXPECT_TRUE(Detect(quads, {3.2, 0.1, 0.05}).empty());
}

TEST_F(DoorDetectionTest, FindsBothDoorsOfACorridor) {
  const Pose2 left{3.6, 1.4, kPi / 2}, end{5.4, 0.1, 0};
  const auto dut = Detect(CorridorQuads(left, end), {});
  ASSERT_EQ(dut.size(), 2u);
  for (const Pose2& truth : {left, end}) {
    const Eigen::Vector2d front = truth * Eigen::Vector2d(-0.085, 0);
    const auto nearest = std::min_element(dut.begin(), dut.end(), [&](const auto& a, const auto& b) {
      return (a.base_from_door.translation() - front).norm() <
             (b.base_from_door.translation() - front).norm();
    });
    EXPECT_LT((nearest->base_from_door.translation() - front).norm(), 0.03);
    EXPECT_NEAR(WrapAngle(nearest->base_from_door.yaw - truth.yaw), 0, 0.05);
    EXPECT_LT(nearest->covariance.trace(), 0.05 * 0.05);
  }
}

TEST_F(DoorDetectionTest, ExchangedImagesShowNoDoor) {
  Detect(test::DoorQuads(), {3.2, 0.1, 0.05});
  EXPECT_TRUE(DetectDoors(MakeView(left_, edges_[1]), MakeView(right_, edges_[0]), {}).empty());
}

}  // namespace
}  // namespace priamos::head
