#include "head/core/doors/door_evidence.hpp"

#include <gtest/gtest.h>

#include "head/core/edges/edge_segments.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

class DoorEvidenceTest : public testing::Test {
 protected:
  DoorEvidenceTest() {
    EdgeOperator op;
    op.Extract(test::RenderQuads(test::DoorQuads(), Lift(truth_), camera_, 2, rng_), edges_);
  }
  /// Of the outer edges of the frame, moved along the wall and up.
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

}  // namespace
}  // namespace priamos::head
