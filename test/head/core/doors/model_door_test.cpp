#include "head/core/doors/model_door.hpp"

#include <gtest/gtest.h>

#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

TEST(DoorOfModel, ADoorsModelGivesItsOpeningAndItsPlanes) {
  const auto dut = DoorOf(test::DoorModel(0.86));
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->opening_width_m, 0.86, 1e-9);
  EXPECT_NEAR(dut->opening_height_m, 2.0, 1e-9);
  EXPECT_NEAR(dut->StopX(), 0.03, 1e-9);
  EXPECT_NEAR(dut->FrontX(), -0.085, 1e-9);
}

TEST(DoorOfModel, WithoutAFrameAroundTheJambsItIsNoDoor) {
  LandmarkModel model = test::DoorModel();
  std::erase_if(model.edges, [](const LandmarkEdge& e) { return std::abs(e.from.y()) > 0.5; });
  EXPECT_FALSE(DoorOf(model));
}

TEST(DoorOfModel, WithOneSideOnlyItIsNoDoor) {
  LandmarkModel model = test::DoorModel();
  std::erase_if(model.edges, [](const LandmarkEdge& e) { return e.side == 2; });
  EXPECT_FALSE(DoorOf(model));
  EXPECT_FALSE(DoorOf(LandmarkModel{}));
}

}  // namespace
}  // namespace priamos::head
