#include "head/core/landmark/other_breadth.hpp"

#include <gtest/gtest.h>

#include <array>

#include "head/core/edges/edge_segments.hpp"
#include "head/core/landmark/pose_refinement.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

/// The lead over the model of a door of 90 cm when a door of that width is seen, its right side where that of
/// the model is.
double LeadWhenWide(double width_m) {
  const CameraModel left = test::HeadCamera(0, 1, 1000, -0.05), right = test::HeadCamera(0, -1, 1000, -0.05);
  const LandmarkModel model = test::DoorModel();
  const Pose2 at{3.2, 0, 0}, seen_at{3.2, (width_m - 0.9) / 2, 0};
  Rng rng(5);
  std::array<EdgeImage, 2> edges;
  EdgeOperator op;
  op.Extract(test::RenderQuads(test::DoorQuads(width_m), Lift(seen_at), left, 3, rng, 60), edges[0]);
  op.Extract(test::RenderQuads(test::DoorQuads(width_m), Lift(seen_at), right, 3, rng, 60), edges[1]);
  const std::array<CameraView, 2> views{MakeView(left, edges[0]), MakeView(right, edges[1])};
  return LeadOfOtherBreadth(model, VisibleAt(model, at), views, Lift(at), kProposed);
}

TEST(OtherBreadth, TheModelOfWhatIsSeenLeadsByFar) {
  EXPECT_LT(LeadWhenWide(0.9), -5);
}

TEST(OtherBreadth, ADoorWithOneSideElsewhereLeadsOverTheModel) {
  for (const double width_m : {0.75, 0.82, 0.96, 1.05}) EXPECT_GT(LeadWhenWide(width_m), 2) << width_m;
}

}  // namespace
}  // namespace priamos::head
