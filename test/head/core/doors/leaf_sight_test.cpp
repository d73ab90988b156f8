#include "head/core/doors/leaf_sight.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "head/core/edges/edge_segments.hpp"
#include "head/core/landmark/landmark.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

using test::Quad;

/// The four sides of an upright box, each with its own grey value.
void AddBox(std::vector<Quad>& quads, const Pose2& at, const Eigen::Vector2d& size, double low, double high,
            double grey) {
  const std::array<Eigen::Vector2d, 4> corner{Eigen::Vector2d(-0.5, -0.5), Eigen::Vector2d(0.5, -0.5),
                                              Eigen::Vector2d(0.5, 0.5), Eigen::Vector2d(-0.5, 0.5)};
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d a = at * corner[i].cwiseProduct(size).eval(),
                          b = at * corner[(i + 1) % 4].cwiseProduct(size).eval();
    quads.push_back(
        {{a.x(), a.y(), low}, {b.x() - a.x(), b.y() - a.y(), 0}, {0, 0, high - low}, grey - 25 * (i % 2)});
  }
}

std::vector<Quad> DoorWithLeaf(const std::string& hinge, double open_deg) {
  auto quads = test::DoorQuads();
  const LeafShape leaf = LeafOf(DoorPlan{}, hinge, open_deg, 0.04);
  AddBox(quads, leaf.door_from_leaf, leaf.size_m, leaf.z_min_m, leaf.z_max_m, 150);
  return quads;
}

class LeafSightTest : public testing::Test {
 protected:
  LeafSight Look(const std::vector<Quad>& quads, const Pose2& base_from_door = {2.6, 0.05, 0.02}) {
    EdgeOperator op;
    std::array<EdgeImage, 2> edges;
    std::array<CameraModel, 2> cameras;
    for (int i = 0; i < 2; ++i) {
      cameras[i] = test::HeadCamera(0, i == 0 ? 1 : -1, 700);
      op.Extract(test::RenderQuads(quads, Lift(base_from_door), cameras[i], 2, rng_), edges[i]);
    }
    return SeeLeaf(DoorPlan{}, base_from_door,
                   {MakeView(cameras[0], edges[0]), MakeView(cameras[1], edges[1])});
  }

  Rng rng_{7};
};

TEST_F(LeafSightTest, ItsAngleIsSeenWithEitherHinge) {
  for (const double deg : {20.0, 45.0, 70.0, 85.0}) {
    const LeafSight left = Look(DoorWithLeaf("left", deg)), right = Look(DoorWithLeaf("right", deg));
    EXPECT_EQ(left.hinge, LeafSight::Hinge::kLeft) << deg << ", log odds " << left.log_odds;
    EXPECT_EQ(right.hinge, LeafSight::Hinge::kRight) << deg << ", log odds " << right.log_odds;
    EXPECT_NEAR(Degrees(left.open_rad), deg, 1);
    EXPECT_NEAR(Degrees(right.open_rad), deg, 1);
    EXPECT_LT(Degrees(left.sigma_rad), 2);
  }
}

TEST_F(LeafSightTest, WithoutALeafNoneIsSeen) {
  EXPECT_EQ(Look(test::DoorQuads()).hinge, LeafSight::Hinge::kNotSeen);
}

TEST_F(LeafSightTest, ALeafBehindTheWallIsNotSeen) {
  EXPECT_EQ(Look(DoorWithLeaf("left", 110)).hinge, LeafSight::Hinge::kNotSeen);
}

TEST_F(LeafSightTest, ALeafBeforeThingsOfTheFarRoomIsSeen) {
  auto quads = DoorWithLeaf("left", 60);
  AddBox(quads, {3, 0.3, 0.4}, {0.4, 0.6}, 0, 1.9, 90);
  AddBox(quads, {2, -0.5, 0.1}, {0.2, 0.2}, 0, 1.6, 210);
  const LeafSight dut = Look(quads);
  EXPECT_EQ(dut.hinge, LeafSight::Hinge::kLeft) << dut.log_odds;
  EXPECT_NEAR(Degrees(dut.open_rad), 60, 1);
}

TEST_F(LeafSightTest, APostOnTheCircleOfTheFreeEdgeIsNoLeaf) {
  for (const double deg : {45.0, 70.0}) {
    auto quads = test::DoorQuads();
    const LeafShape leaf = LeafOf(DoorPlan{}, "left", deg, 0.04);
    const Eigen::Vector2d free_end = leaf.door_from_leaf * Eigen::Vector2d(0, -leaf.size_m.y() / 2);
    AddBox(quads, {free_end.x(), free_end.y(), 0}, {0.06, 0.06}, 0, 2.6, 100);
    EXPECT_EQ(Look(quads).hinge, LeafSight::Hinge::kNotSeen) << deg;
  }
}

}  // namespace
}  // namespace priamos::head
