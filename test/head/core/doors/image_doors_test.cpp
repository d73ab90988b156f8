#include "head/core/doors/image_doors.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "head/core/doors/door_detection.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "test/head/exact_view.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

constexpr double kHeight_m = 1.25;

CameraModel OwnFrame() {
  CameraModel camera;
  camera.image_from_base << 600, 0, 384, 0, 0, 600, 288, 0, 0, 0, 1, 0;
  return camera;
}

void Append(std::vector<test::Quad>& all, std::vector<test::Quad> quads, const Pose2& there) {
  const Eigen::Isometry3d motion = Lift(there);
  for (test::Quad& q : quads) {
    q.corner = motion * q.corner;
    q.u = motion.linear() * q.u;
    q.v = motion.linear() * q.v;
  }
  all.insert(all.end(), quads.begin(), quads.end());
}

/// A picture that a tilted and rolled camera takes of a scene, looked at with what it tells of the stand.
class ImageDoorsTest : public testing::Test {
 protected:
  DoorsInImage Detect(const std::vector<test::Quad>& quads, std::optional<double> height_m = kHeight_m) {
    EdgeOperator op(DoorEdges());
    op.Extract(test::RenderQuads(quads, Eigen::Isometry3d::Identity(), OnTheFloor(camera_, stand_), 2, rng_),
               edges_);
    const CameraView view = MakeView(camera_, edges_);
    vertical_ = FindVertical(std::span(&view, 1), {});
    EXPECT_EQ(vertical_.verdict, UprightVerdict::kFound);
    return DetectDoorsInImage(view, StandOf(vertical_.up, 0), TiltAndRollCovariance(vertical_), height_m, {});
  }
  std::vector<test::Quad> Door(const Pose2& at) const {
    std::vector<test::Quad> quads;
    Append(quads, test::DoorQuads(), at);
    return quads;
  }

  Rng rng_{5};
  const CameraModel camera_ = OwnFrame();
  const CameraStand stand_{kHeight_m, 0.05, 0.02};
  VerticalDirection vertical_;
  EdgeImage edges_;
};

TEST_F(ImageDoorsTest, OneImageWithTheHeightTellsWhereADoorIs) {
  const Pose2 truth{4.2, 0.2, 0.4};
  const DoorsInImage dut = Detect(Door(truth));
  ASSERT_EQ(dut.doors.size(), 1u);
  const ImageDoor& door = dut.doors[0];
  const Eigen::Vector2d front = truth * Eigen::Vector2d(-0.085, 0);
  EXPECT_NEAR(door.base_from_door.yaw, truth.yaw, 0.02);
  EXPECT_NEAR(door.range_m, front.norm(), 0.2);
  EXPECT_LT(std::abs(door.range_m - front.norm()), 4 * door.range_sigma_m);
  EXPECT_NEAR(door.shape, 1.02 / 2.06, 0.04);
  EXPECT_TRUE(door.on_floor);
  EXPECT_NEAR(Degrees(StandOf(vertical_.up, 0).tilt_rad - stand_.tilt_rad), 0, 0.4);
}

TEST_F(ImageDoorsTest, WithoutTheHeightTheDoorItselfTellsIt) {
  const DoorsInImage dut = Detect(Door({4.2, 0.2, 0.4}), std::nullopt);
  ASSERT_EQ(dut.doors.size(), 1u);
  EXPECT_NEAR(dut.height_m, kHeight_m, 0.15);
  EXPECT_GT(dut.height_sigma_m, 0.01);
  EXPECT_NEAR(dut.doors[0].range_m, 4.2, 0.5);
}

TEST_F(ImageDoorsTest, WhatHangsOnAWallIsNone) {
  std::vector<test::Quad> quads = test::WallQuads();
  quads.push_back({{-0.08, -0.4, 0.9}, {0, 0.9, 0}, {0, 0, 1.0}, 90});
  std::vector<test::Quad> all;
  Append(all, quads, {4.0, 0, 0});
  all.push_back({{3.9, 1.0, 0}, {0, 0.3, 0}, {0, 0, 2.6}, 150});  // a post, so that there are uprights
  EXPECT_TRUE(Detect(all).doors.empty());
}

TEST_F(ImageDoorsTest, ADoorIsReportedOnce) {
  std::vector<test::Quad> quads = Door({4.0, 1.0, 0});
  Append(quads, test::DoorQuads(0.8), {4.0, -1.0, 0});
  const DoorsInImage dut = Detect(quads);
  for (std::size_t i = 0; i < dut.doors.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(
          (dut.doors[i].base_from_door.translation() - dut.doors[j].base_from_door.translation()).norm(),
          0.6);
}

RC_GTEST_PROP(DetectDoorsInImage, IsFiniteWhateverTheLinesAre, ()) {
  Rng rng(*rc::gen::inRange(0, 100000));
  test::ExactView picture(OwnFrame());
  const int n = *rc::gen::inRange(0, 60);
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d from(rng.Uniform(0, 767), rng.Uniform(0, 575));
    const bool upright = rng.Chance(0.5);
    const double length = rng.Uniform(10, 300);
    picture.Draw(
        from, from + (upright ? Eigen::Vector2d(0, length) : Eigen::Vector2d(length, rng.Uniform(-80, 80))));
  }
  const CameraView view = picture.View();
  const DoorsInImage dut =
      DetectDoorsInImage(view, {0, 0.1, 0.05}, Eigen::Matrix2d::Identity() * 1e-5, std::nullopt, {});
  RC_ASSERT(std::isfinite(dut.height_m) && std::isfinite(dut.height_sigma_m));
  for (const ImageDoor& door : dut.doors) {
    RC_ASSERT(std::isfinite(door.range_sigma_m) && std::isfinite(door.shape_sigma));
    RC_ASSERT(std::isfinite(door.yaw_sigma_rad) && std::isfinite(door.log_odds));
    RC_ASSERT(door.corners[0].allFinite() && door.feet[0].allFinite());
  }
}

}  // namespace
}  // namespace priamos::head
