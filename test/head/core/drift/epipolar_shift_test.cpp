#include "head/core/drift/epipolar_shift.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "head/core/edges/edge_segments.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector3d;

/// A wall with boards of all sizes: ends of edges everywhere.
std::vector<test::Quad> Boards(Rng& rng) {
  std::vector<test::Quad> quads{{{0, -3, 0}, {0, 6, 0}, {0, 0, 2.6}, 170}};
  for (int i = 0; i < 14; ++i) {
    const double y = -1.3 + 0.19 * i, z = rng.Uniform(0.7, 1.2);
    quads.push_back({{-rng.Uniform(0.05, 0.6), y, z},
                     {0, rng.Uniform(0.06, 0.12), 0},
                     {0, 0, rng.Uniform(0.15, 0.5)},
                     rng.Uniform(30, 120)});
  }
  return quads;
}

/// The camera after a turn about its own axes (x right, y down, z forward).
CameraModel Turned(CameraModel camera, const Vector3d& turn, double focal) {
  Eigen::Matrix3d k;
  k << focal, 0, camera.centre_px.x(), 0, focal, camera.centre_px.y(), 0, 0, 1;
  const Eigen::Matrix3d back = turn.norm() > 0
                                   ? Eigen::AngleAxisd(-turn.norm(), turn.normalized()).toRotationMatrix()
                                   : Eigen::Matrix3d::Identity();
  camera.image_from_base = k * back * k.inverse() * camera.image_from_base;
  return camera;
}

class EpipolarShiftTest : public testing::Test {
 protected:
  /// What is measured if the true right camera is turned against the one that is believed.
  std::optional<EpipolarShift> Measure(const Vector3d& turn) {
    const CameraModel true_right = Turned(right_, turn, kFocal);
    const auto boards = Boards(rng_);
    const Eigen::Isometry3d wall = Lift({3, 0, 0});
    EdgeOperator op;
    op.Extract(test::RenderQuads(boards, wall, left_, 2, rng_), edges_[0]);
    op.Extract(test::RenderQuads(boards, wall, true_right, 2, rng_), edges_[1]);
    const CameraView left = MakeView(left_, edges_[0]), right = MakeView(right_, edges_[1]);
    return MeasureEpipolarShift(left, right, MatchBinocular(left, right, {}));
  }

  static constexpr double kFocal = 900;
  Rng rng_{3};
  const CameraModel left_ = test::HeadCamera(0, 1, kFocal), right_ = test::HeadCamera(0, -1, kFocal);
  EdgeImage edges_[2];
};

TEST_F(EpipolarShiftTest, IsZeroWhenNothingHasMoved) {
  for (int i = 0; i < 3; ++i) {
    const auto dut = Measure(Vector3d::Zero());
    ASSERT_TRUE(dut);
    EXPECT_LT(std::abs(dut->down_px), 2.5 * dut->sigma_px);
    EXPECT_LT(dut->sigma_px, 0.25);
  }
}

TEST_F(EpipolarShiftTest, APixelUpOrDownIsMeasured) {
  for (const double px : {1.0, -1.0, 3.0}) {
    const auto dut = Measure({px / kFocal, 0, 0});
    ASSERT_TRUE(dut);
    EXPECT_NEAR(dut->down_px, px, 0.3) << "a camera that turns about x to the right sees the world lower";
    const StereoDrift drift = Fuse(UnknownDrift(), *dut, right_);
    EXPECT_NEAR(drift.turn_rad.x() * kFocal, px, 0.3);
    EXPECT_LT(std::sqrt(drift.covariance(0, 0)) * kFocal, 0.5) << "some of it may still be a roll";
  }
}

TEST_F(EpipolarShiftTest, SharpensWhatALandmarkLeavesOpen) {
  const auto dut = Measure({1 / kFocal, 0, 0});
  ASSERT_TRUE(dut);
  StereoDrift weak{Vector3d::Zero(), Vector3d(4e-6, 1e-7, 1e-7).asDiagonal()};
  const StereoDrift drift = Fuse(weak, *dut, right_);
  EXPECT_NEAR(drift.turn_rad.x() * kFocal, 1, 0.3);
  EXPECT_LT(std::sqrt(drift.covariance(0, 0)) * kFocal, 0.3);
  EXPECT_GT(drift.turn_rad.x() / std::sqrt(drift.covariance(0, 0)), 4);
}

TEST_F(EpipolarShiftTest, WithoutMatchesThereIsNone) {
  const CameraView nothing{&left_, &edges_[0], {}, {}, {}};
  EXPECT_FALSE(MeasureEpipolarShift(nothing, nothing, {}));
}

}  // namespace
}  // namespace priamos::head
