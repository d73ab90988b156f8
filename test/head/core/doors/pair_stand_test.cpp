#include "head/core/doors/pair_stand.hpp"

#include <gtest/gtest.h>

#include "head/core/edges/edge_segments.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

constexpr double kBaseline_m = 0.3;

class PairStandTest : public testing::Test {
 protected:
  PairStandTest() {
    for (int c = 0; c < 2; ++c)
      cameras_[c].image_from_base << 600, 0, 384, -600 * kBaseline_m * c, 0, 600, 288, 0, 0, 0, 1, 0;
  }
  PairStand Find(const std::vector<test::Quad>& quads, const Pose2& there) {
    std::array<EdgeImage, 2> edges;
    for (int c = 0; c < 2; ++c) {
      EdgeOperator op(DoorEdges());
      op.Extract(test::RenderQuads(quads, Lift(there), OnTheFloor(cameras_[c], stand_), 2, rng_), edges[c]);
    }
    return FindPairStand(MakeView(cameras_[0], edges[0]), MakeView(cameras_[1], edges[1]), {});
  }

  Rng rng_{3};
  std::array<CameraModel, 2> cameras_;
  CameraStand stand_{1.4, 0.06, -0.02};
};

TEST_F(PairStandTest, ADoorWithItsFeetTellsTheWholeStand) {
  const PairStand dut = Find(test::DoorQuads(), {4.5, 0.1, 0.2});
  ASSERT_EQ(dut.vertical.verdict, UprightVerdict::kFound);
  EXPECT_NEAR(dut.stand.tilt_rad, stand_.tilt_rad, 0.006);
  EXPECT_NEAR(dut.stand.roll_rad, stand_.roll_rad, 0.004);
  EXPECT_NE(dut.source, HeightSource::kNothing);
  EXPECT_NEAR(dut.stand.height_m, stand_.height_m, 0.1);
  EXPECT_LT(std::abs(dut.stand.height_m - stand_.height_m), 3 * dut.height_sigma_m);
}

TEST_F(PairStandTest, WithoutUprightsThereIsNone) {
  const PairStand dut = Find({}, {});
  EXPECT_NE(dut.vertical.verdict, UprightVerdict::kFound);
}

TEST(HeightSource, EachIsDescribed) {
  for (const auto source : {HeightSource::kNothing, HeightSource::kFeet, HeightSource::kLintels})
    EXPECT_GT(std::string(Describe(source)).size(), 4u);
}

}  // namespace
}  // namespace priamos::head
