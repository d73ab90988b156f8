#include "head/core/stereo/plan_line.hpp"

#include <gtest/gtest.h>

#include "test/head/exact_view.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

TEST(PlanLine, ALevelEdgeLiesOnItsLineInTheFloorPlan) {
  test::ExactView view(test::HeadCamera(0, 1));
  view.See({3, 0.5, 1.6}, {3.4, -0.2, 1.6});
  const CameraView seen = view.View();
  const PlanLine line(seen.lines[0], 1.6);
  EXPECT_NEAR(line.normal.dot(Eigen::Vector2d(3, 0.5)) + line.offset, 0, 1e-3);
  EXPECT_NEAR(line.normal.dot(Eigen::Vector2d(3.4, -0.2)) + line.offset, 0, 1e-3);
}

TEST(PlanLine, LinesCrossWhereTheCornerIs) {
  test::ExactView view(test::HeadCamera(0, 1));
  view.See({3, 0.5, 1.6}, {3.4, -0.2, 1.6});
  view.See({3, 0.5, 0.8}, {3, 0.5, 1.6});
  const CameraView seen = view.View();
  const auto at = Crossing(PlanLine(seen.lines[0], 1.6), PlanLine(seen.lines[1], 1.6));
  ASSERT_TRUE(at);
  EXPECT_NEAR((*at - Eigen::Vector2d(3, 0.5)).norm(), 0, 0.01);
  EXPECT_FALSE(Crossing(PlanLine(seen.lines[0], 1.6), PlanLine(seen.lines[0], 1.6)));
}

}  // namespace
}  // namespace priamos::head
