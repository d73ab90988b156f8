#include "world/core/sonar/acoustic_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace priamos::world {
namespace {

Solid Box(Pose2 pose, Eigen::Vector2d size, std::string material = "plaster", double low = 0,
          double high = 2) {
  return {"box", pose, size, low, high, std::move(material)};
}

AcousticScene SceneOf(const std::vector<Solid>& solids) {
  return {solids, 0.4, 0.05, EchoMaterial::Defaults()};
}

TEST(AcousticSceneTest, SkirtingAndLintelAreNotHeard) {
  const AcousticScene dut =
      SceneOf({Box({1, 0, 0}, {0.1, 4}, "skirting", 0, 0.08), Box({2, 0, 0}, {0.1, 4}, "plaster", 2, 2.5)});
  EXPECT_FALSE(dut.Nearest({0, 0}, {1, 0}, 5));
}

TEST(AcousticSceneTest, NearestOfTwoAndItsMaterial) {
  const AcousticScene dut =
      SceneOf({Box({3, 0, 0}, {0.2, 4}), Box({1.5, 0, 0}, {0.2, 4}, "fabric"), Box({4, 0, 0}, {0.2, 4})});
  const auto hit = dut.Nearest({0, 0}, {1, 0}, 5);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance_m, 1.4, 1e-12);
  EXPECT_EQ(hit->material->material, "fabric");
}

TEST(AcousticSceneTest, AnUnlistedMaterialAnswersLikeTheFirst) {
  const AcousticScene dut = SceneOf({Box({3, 0, 0}, {0.2, 4}, "jelly")});
  EXPECT_EQ(dut.Nearest({0, 0}, {1, 0}, 5)->material->material, "plaster");
}

TEST(AcousticSceneTest, AroundKeepsWhatReachesInAndItsMaterial) {
  const AcousticScene whole =
      SceneOf({Box({3, 0, 0}, {0.2, 4}, "fabric"), Box({9, 0, 0}, {0.2, 4}), Box({0, 7, 0}, {0.2, 6})});
  const AcousticScene dut = whole.Around({0, 0}, 5);
  EXPECT_EQ(dut.Nearest({0, 0}, {1, 0}, 20)->material->material, "fabric");
  EXPECT_FALSE(dut.Nearest({5, 0}, {1, 0}, 20));
  EXPECT_TRUE(dut.Nearest({0, 0}, {0, 1}, 20));
  EXPECT_EQ(dut.edges().size(), 6u);  // four of the near box, the two near ones of the third
}

TEST(AcousticSceneTest, AFreeStandingBoxHasFourEdges) {
  EXPECT_EQ(SceneOf({Box({3, 0, 0}, {1, 1})}).edges().size(), 4u);
}

TEST(AcousticSceneTest, JoinedWallsHaveNoEdgeAtTheirJoint) {
  const AcousticScene dut = SceneOf({Box({0, 0, 0}, {0.2, 2}), Box({0, 2, 0}, {0.2, 2})});
  EXPECT_EQ(dut.edges().size(), 4u);
}

TEST(AcousticSceneTest, AnEdgeBehindABoxIsNotVisible) {
  const AcousticScene dut = SceneOf({Box({2, 0, 0}, {0.2, 1}), Box({4, 0, 0}, {0.2, 0.4})});
  EXPECT_FALSE(dut.Visible({0, 0}, {3.9, 0.2}));
  EXPECT_TRUE(dut.Visible({0, 0}, {1.9, 0.5}));
}

}  // namespace
}  // namespace priamos::world
