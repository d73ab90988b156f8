#include "head/core/look/far_sight.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "common/square.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

const Pose2 kBefore{1.8, 0.05, 0.03}, kInDoor{0.35, -0.02, 0.01};  // base_from_landmark
constexpr double kDrift_rad = Radians(0.4), kSigma_rad = Radians(0.3), kSigma_m = 0.005;
constexpr double kFixSigma_rad = Radians(0.05);

/// A dark board on the wall of the far room.
test::Quad Board(double y, double width_m, double grey = 90) {
  return {{3.9, y, 0.8}, {0, width_m, 0}, {0, 0, 0.9}, grey};
}

/// The door, and beyond it boards of different breadths.
std::vector<test::Quad> DoorAndBoards(double aside_m = 0) {
  std::vector<test::Quad> quads = test::DoorQuads();
  quads.push_back(Board(-0.9 + aside_m, 0.25));
  quads.push_back(Board(-0.25 + 2 * aside_m, 0.4, 120));
  quads.push_back(Board(0.5 - aside_m, 0.3));
  return quads;
}

class FarSightTest : public testing::Test {
 protected:
  StereoViews See(const std::vector<test::Quad>& quads, const Pose2& base_from_landmark) {
    for (std::size_t c = 0; c < 2; ++c)
      operator_.Extract(test::RenderQuads(quads, Lift(base_from_landmark), cameras_[c], 2, rng_), edges_[c]);
    return {MakeView(cameras_[0], edges_[0]), MakeView(cameras_[1], edges_[1])};
  }
  void Learn(const std::vector<test::Quad>& quads, const Pose2& at, Verdict verdict = Verdict::kFound) {
    const StereoViews views = See(quads, at);
    LandmarkFix fix;
    fix.verdict = verdict;
    fix.base_from_landmark = at;
    fix.covariance = Eigen::Vector3d(Square(0.002), Square(0.002), Square(kFixSigma_rad)).asDiagonal();
    far_.Learn(fix, views[0], MatchBinocular(views[0], views[1], {}));
  }
  /// A look from the doorway by a base that believes its heading to be wrong by kDrift_rad.
  LandmarkFix LookFromTheDoor(const std::vector<test::Quad>& quads) {
    const Eigen::Matrix3d covariance =
        Eigen::Vector3d(Square(kSigma_m), Square(kSigma_m), Square(kSigma_rad)).asDiagonal();
    const StereoViews views = See(quads, kInDoor);
    return SeeFar(far_, {Pose2{0, 0, kDrift_rad} * kInDoor, covariance}, views);
  }

  Rng rng_{5};
  const std::array<CameraModel, 2> cameras_{test::HeadCamera(0, 1, 890), test::HeadCamera(0, -1, 890)};
  EdgeOperator operator_;
  std::array<EdgeImage, 2> edges_;
  FarEdges far_;
};

TEST_F(FarSightTest, ALookBeforeTheDoorShowsWhereUprightEdgesStandBeyondIt) {
  Learn(DoorAndBoards(), kBefore);
  ASSERT_GE(far_.edges().size(), 4u);
  for (const FarEdge& edge : far_.edges()) EXPECT_NEAR(edge.at.x(), 3.9, 0.12) << edge.at.transpose();
  EXPECT_DOUBLE_EQ(far_.heading_variance(), Square(kFixSigma_rad));
}

TEST_F(FarSightTest, TheSameEdgesOfASecondLookAreNotLearntTwice) {
  Learn(DoorAndBoards(), kBefore);
  const std::size_t before = far_.edges().size();
  Learn(DoorAndBoards(), kBefore);
  EXPECT_EQ(far_.edges().size(), before);
}

TEST_F(FarSightTest, WhereTheLandmarkWasNotFoundNothingIsLearnt) {
  Learn(DoorAndBoards(), kBefore, Verdict::kTooFewEdges);
  EXPECT_TRUE(far_.edges().empty());
  EXPECT_EQ(LookFromTheDoor(DoorAndBoards()).verdict, Verdict::kTooFewEdges);
}

TEST_F(FarSightTest, InTheDoorTheyTellTheHeadingAndNotThePlace) {
  Learn(DoorAndBoards(), kBefore);
  const LandmarkFix fix = LookFromTheDoor(DoorAndBoards());
  ASSERT_EQ(fix.verdict, Verdict::kFound);
  EXPECT_GE(fix.n_matched, 4);
  // At the place that was expected, which is right but for the turn about the base.
  EXPECT_NEAR(fix.base_from_landmark.yaw, kInDoor.yaw, Radians(0.06));
  EXPECT_NEAR(fix.base_from_landmark.y, kInDoor.y, 0.001);
  EXPECT_GT(fix.covariance(0, 0), Square(5 * kSigma_m));
  EXPECT_EQ(fix.own_share, 1);
  // With the place known, the heading is known about as well as by the fix that taught the edges.
  const Eigen::Matrix3d information = fix.covariance.inverse();
  const double sigma = 1 / std::sqrt(information(2, 2));
  EXPECT_GT(sigma, kFixSigma_rad);
  EXPECT_LT(sigma, 2 * kFixSigma_rad);
}

TEST_F(FarSightTest, ThingsThatStandElsewhereNowTellNothing) {
  Learn(DoorAndBoards(), kBefore);
  EXPECT_NE(LookFromTheDoor(DoorAndBoards(0.11)).verdict, Verdict::kFound);
}

TEST_F(FarSightTest, EqualStripesAreAmbiguous) {
  std::vector<test::Quad> stripes = test::DoorQuads();
  for (int i = -8; i < 8; ++i) stripes.push_back(Board(0.08 * i, 0.04));
  Learn(stripes, kBefore);
  const LandmarkFix fix = LookFromTheDoor(stripes);
  EXPECT_TRUE(fix.verdict != Verdict::kFound ||
              std::abs(WrapAngle(fix.base_from_landmark.yaw - kInDoor.yaw)) < Radians(0.1))
      << Degrees(fix.base_from_landmark.yaw);
}

}  // namespace
}  // namespace priamos::head
