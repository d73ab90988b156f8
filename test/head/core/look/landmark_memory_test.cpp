#include "head/core/look/landmark_memory.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "head/core/edges/edge_segments.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

const Pose2 kTruth{3.2, 0.05, 0.02};
const double kFrameOverWall = std::log(110.0 / 170);  // of DoorQuads

class LandmarkMemoryTest : public testing::Test {
 protected:
  LandmarkFix Look(const std::vector<test::Quad>& quads, LandmarkMemory& memory) {
    std::vector<CameraView> views;
    for (std::size_t c = 0; c < 2; ++c) {
      operator_.Extract(test::RenderQuads(quads, Lift(kTruth), cameras_[c], 3, rng_), edges_[c]);
      views.push_back(MakeView(cameras_[c], edges_[c]));
    }
    const Eigen::Matrix3d covariance =
        Eigen::Vector3d(0.115 * 0.115, 0.115 * 0.115, 0.05 * 0.05).asDiagonal();
    return memory.Find(finder_, model_, {{kTruth.x + 0.05, kTruth.y - 0.05, kTruth.yaw}, covariance}, views);
  }

  static LandmarkFinder Finder() {
    LandmarkFixOptions options;
    options.solver.model_sigma_m = 0.005;
    return LandmarkFinder(options);
  }

  Rng rng_{7};
  const std::array<CameraModel, 2> cameras_{test::HeadCamera(0, 1, 1000, -0.05),
                                            test::HeadCamera(0, -1, 1000, -0.05)};
  const LandmarkModel model_ = test::DoorModel();
  const LandmarkFinder finder_ = Finder();
  EdgeOperator operator_;
  std::array<EdgeImage, 2> edges_;
  LandmarkMemory dut_;
};

TEST_F(LandmarkMemoryTest, GreysOfALookAreKeptAndSpeakForTheNext) {
  const LandmarkFix first = Look(test::DoorQuads(), dut_);
  ASSERT_EQ(first.verdict, Verdict::kFound) << Describe(first.verdict);
  ASSERT_EQ(dut_.greys().size(), model_.edges.size());
  ASSERT_TRUE(dut_.greys()[0] && dut_.greys()[1]);
  EXPECT_NEAR(dut_.greys()[0]->ratio, kFrameOverWall, 0.05) << "left jamb, frame on its right";
  EXPECT_NEAR(dut_.greys()[1]->ratio, -kFrameOverWall, 0.05);
  LandmarkMemory without({}, false);
  Look(test::DoorQuads(), without);
  const LandmarkFix again = Look(test::DoorQuads(), dut_), edges_alone = Look(test::DoorQuads(), without);
  ASSERT_EQ(again.verdict, Verdict::kFound);
  ASSERT_EQ(edges_alone.verdict, Verdict::kFound);
  EXPECT_TRUE(without.greys().empty());
  EXPECT_GT(again.log_odds, edges_alone.log_odds + 5);
}

TEST_F(LandmarkMemoryTest, ALookThatDoesNotFindItChangesNothing) {
  Look(test::DoorQuads(), dut_);
  const double before = dut_.greys().at(0)->sigma;
  ASSERT_NE(Look(test::WallQuads(), dut_).verdict, Verdict::kFound);
  EXPECT_EQ(dut_.greys().at(0)->sigma, before);
}

TEST_F(LandmarkMemoryTest, InOtherLightItIsFoundAllTheSameAndItsGreysAreLearnedAnew) {
  for (int i = 0; i < 3; ++i) Look(test::DoorQuads(), dut_);
  std::vector<test::Quad> negative = test::DoorQuads();
  for (test::Quad& quad : negative) quad.grey = 230 - quad.grey;
  const LandmarkFix fix = Look(negative, dut_);
  ASSERT_EQ(fix.verdict, Verdict::kFound) << Describe(fix.verdict);
  EXPECT_NEAR(fix.base_from_landmark.y, kTruth.y, 0.003);
  EXPECT_NEAR(dut_.greys().at(0)->ratio, std::log(120.0 / 60), 0.1);
}

}  // namespace
}  // namespace priamos::head
