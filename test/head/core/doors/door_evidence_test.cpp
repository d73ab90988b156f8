#include "head/core/doors/door_evidence.hpp"

#include <gtest/gtest.h>

#include "head/core/edges/edge_segments.hpp"
#include "test/head/exact_view.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

class DoorEvidenceTest : public testing::Test {
 protected:
  DoorEvidenceTest() {
    EdgeOperator op;
    op.Extract(test::RenderQuads(test::DoorQuads(), Lift(truth_), camera_, 2, rng_), edges_);
  }
  /// Evidence of the outer edges of the frame, moved along the wall and up [m].
  DoorEvidence Weigh(double aside_m, double up_m) {
    const DoorShape shape{truth_ * Eigen::Vector2d(-0.085, 0.51 + aside_m),
                          truth_ * Eigen::Vector2d(-0.085, -0.51 + aside_m), 2.06 + up_m};
    return WeighDoor(MakeView(camera_, edges_), shape);
  }

  Rng rng_{7};
  const Pose2 truth_{3.4, 0.1, 0.1};
  const CameraModel camera_ = test::HeadCamera(0, 1, 700);
  EdgeImage edges_;
};

TEST_F(DoorEvidenceTest, WhereADoorIsAllEdgesAreCovered) {
  const DoorEvidence dut = Weigh(0, 0);
  EXPECT_GT(dut.lintel.share, 0.9);
  EXPECT_NEAR(dut.lintel.first_px, 0, 3);
  EXPECT_NEAR(dut.lintel.last_px, 0, 3);
  for (const Cover& upright : dut.uprights) EXPECT_GT(upright.share, 0.9);
  EXPECT_GT(dut.log_odds, 3);
}

TEST_F(DoorEvidenceTest, BesideItTheEdgesAreMissing) {
  EXPECT_LT(Weigh(0.2, 0).log_odds, 0);
  EXPECT_LT(Weigh(0, -0.3).log_odds, 0);
  EXPECT_LT(Weigh(0.2, -0.3).log_odds, Weigh(0.2, 0).log_odds);
}

/// A door 4 m away, drawn line by line; its uprights' feet are in the picture.
class DrawnDoorTest : public testing::Test {
 protected:
  using Vector3 = Eigen::Vector3d;

  static Vector3 Left(double z, double inwards_m = 0) { return {4, 0.45 - inwards_m, z}; }
  static Vector3 Right(double z, double inwards_m = 0) { return {4, -0.45 + inwards_m, z}; }
  /// Between the uprights, from 0 at the left to 1 at the right one.
  static Vector3 OnLintel(double share, double z = kHeight) { return {4, 0.45 - 0.9 * share, z}; }
  void DrawUprights() { scene_.See(Left(kHeight), Left(0)), scene_.See(Right(kHeight), Right(0)); }
  void DrawLintel() { scene_.See(OnLintel(0), OnLintel(1)); }
  DoorEvidence Weigh() { return WeighDoor(scene_.View(), {{4, 0.45}, {4, -0.45}, kHeight}); }
  double MetrePx() const {
    return (scene_.camera().Project(Left(1)) - scene_.camera().Project(Left(0))).norm();
  }

  static constexpr double kHeight = 2.0;
  test::ExactView scene_{test::HeadCamera(0, 1, 700)};
};

TEST_F(DrawnDoorTest, AllThreeEdgesAreCoveredFromEndToEnd) {
  DrawUprights();
  DrawLintel();
  const DoorEvidence dut = Weigh();
  EXPECT_NEAR(dut.lintel.share, 1, 1e-6);
  EXPECT_EQ(dut.lintel.line, 2);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(dut.uprights[i].share, 1, 0.02);
    EXPECT_EQ(dut.uprights[i].line, i);
    EXPECT_TRUE(dut.foot_inside[i]);
    EXPECT_NEAR(dut.hangs_m[i], 0, 0.02);
  }
  EXPECT_EQ(dut.sill, 0);
}

TEST_F(DrawnDoorTest, EveryEdgeThatIsMissingCountsAgainstIt) {
  DrawUprights();
  DrawLintel();
  const double all = Weigh().log_odds;
  for (int missing = 0; missing < 3; ++missing) {
    test::ExactView part(scene_.camera());
    for (int i = 0; i < 3; ++i) {
      const EdgeSegment& s = scene_.edges().segments[i];
      if (i != missing) part.Draw(s.begin, s.end);
    }
    const DoorEvidence dut = WeighDoor(part.View(), {{4, 0.45}, {4, -0.45}, kHeight});
    EXPECT_LT(dut.log_odds, all - 2) << missing;
  }
}

TEST_F(DrawnDoorTest, PiecesAddUpAndSmallGapsAreBridged) {
  // a gap of 5 px
  scene_.See(OnLintel(0), OnLintel(0.4));
  scene_.See(OnLintel(0.43), OnLintel(0.8));
  const DoorEvidence dut = Weigh();
  EXPECT_NEAR(dut.lintel.share, 0.8, 0.01);
  EXPECT_EQ(dut.lintel.line, 0) << "the longer piece";
  const double width_px =
      (scene_.camera().Project(OnLintel(1)) - scene_.camera().Project(OnLintel(0))).norm();
  EXPECT_NEAR(dut.lintel.last_px, -0.2 * width_px, 0.5);
  EXPECT_NEAR(dut.lintel.first_px, 0, 0.1);
}

TEST_F(DrawnDoorTest, LargeGapsAreNotCovered) {
  scene_.See(OnLintel(0.1), OnLintel(0.4));
  scene_.See(OnLintel(0.6), OnLintel(1.2));
  const DoorEvidence dut = Weigh();
  EXPECT_NEAR(dut.lintel.share, 0.3 + 0.4, 0.01);
  EXPECT_GT(dut.lintel.first_px, 10) << "it begins late";
  EXPECT_GT(dut.lintel.last_px, 20) << "and runs on";
}

TEST_F(DrawnDoorTest, PiecesOfBothContrastsAreNotOneEdge) {
  scene_.See(OnLintel(0), OnLintel(0.6));
  scene_.See(OnLintel(1), OnLintel(0.6));
  EXPECT_NEAR(Weigh().lintel.share, 0.6, 0.01) << "the better of both";
}

TEST_F(DrawnDoorTest, LinesBesideOrTurnedAreNotTheLintel) {
  const Eigen::Vector2d a = scene_.camera().Project(OnLintel(0)), b = scene_.camera().Project(OnLintel(1));
  const auto share = [&](double first_px, double last_px) {
    test::ExactView one(scene_.camera());
    one.Draw(a + Eigen::Vector2d(0, first_px), b + Eigen::Vector2d(0, last_px));
    return WeighDoor(one.View(), {{4, 0.45}, {4, -0.45}, kHeight}).lintel.share;
  };
  EXPECT_GT(share(1.9, 1.9), 0.95);
  EXPECT_EQ(share(2.1, 2.1), 0);
  EXPECT_GT(share(-3, 3), 0.95) << "6 px on 168 are less than 0.04 rad";
  EXPECT_EQ(share(-5, 5), 0);
}

TEST_F(DrawnDoorTest, UprightsThatEndAboveTheFloorHang) {
  scene_.See(Left(kHeight), Left(0.5));
  scene_.See(Right(kHeight), Right(0.7));
  DrawLintel();
  const DoorEvidence dut = Weigh();
  EXPECT_NEAR(dut.hangs_m[0], 0.5, 0.02);
  EXPECT_NEAR(dut.hangs_m[1], 0.7, 0.02);
}

TEST_F(DrawnDoorTest, ALevelEdgeBelowHangingUprightsIsAWindow) {
  scene_.See(Left(kHeight), Left(0.8));
  scene_.See(Right(kHeight), Right(0.8));
  DrawLintel();
  const DoorEvidence open = Weigh();
  EXPECT_EQ(open.sill, 0);
  scene_.See(Left(0.8), Right(0.8));
  const DoorEvidence window = Weigh();
  EXPECT_GT(window.sill, 0.9);
  EXPECT_LT(window.log_odds, open.log_odds - 5);
}

TEST_F(DrawnDoorTest, AFrameHasASecondLineInsideOfEachEdge) {
  DrawUprights();
  DrawLintel();
  const DoorEvidence bare = Weigh();
  EXPECT_EQ(bare.frame_lintel, 0);
  scene_.See(OnLintel(0, kHeight - 0.06), OnLintel(1, kHeight - 0.06));
  scene_.See(Left(kHeight, 0.06), Left(0.5, 0.06));
  const DoorEvidence framed = Weigh();
  EXPECT_GT(framed.frame_lintel, 0.95);
  EXPECT_NEAR(framed.frame_uprights[0], 0.75, 0.03) << "1.5 of 2 m";
  EXPECT_LT(framed.frame_uprights[1], 0.1);
  EXPECT_GT(framed.log_odds, bare.log_odds + 5);
}

TEST_F(DrawnDoorTest, ALineOutsideOfTheDoorIsNoFrame) {
  DrawUprights();
  DrawLintel();
  scene_.See(OnLintel(0, kHeight + 0.06), OnLintel(1, kHeight + 0.06));
  scene_.See(OnLintel(0, kHeight - 0.5), OnLintel(1, kHeight - 0.5));  // and one much too far inside
  EXPECT_EQ(Weigh().frame_lintel, 0);
}

TEST_F(DrawnDoorTest, NothingSeenIsNoDoor) {
  const DoorEvidence dut = Weigh();
  EXPECT_LT(dut.log_odds, -10);
  EXPECT_EQ(dut.lintel.share, 0);
  EXPECT_EQ(dut.lintel.line, -1);
}

}  // namespace
}  // namespace priamos::head
