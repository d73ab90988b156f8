#include "head/core/doors/door_state.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace priamos::head {
namespace {

const OpeningShape kOpening{{2, 0, 0}, 0.9, 2.0};

/// Pieces of a leaf that is hinged at y = 0.45, 6 cm behind the front, every 5 cm.
std::vector<SurfacePoint> LeafAt(double open_rad) {
  std::vector<SurfacePoint> points;
  for (double along = 0.1; along < 0.85; along += 0.05)
    points.push_back({{0.06 + along * std::sin(open_rad), 0.45 - along * std::cos(open_rad)}, 0.004});
  return points;
}

TEST(DoorState, ALeafInThePlaneOfTheWallIsClosed) {
  EXPECT_EQ(StateOf(kOpening, LeafAt(0)).State(2), DoorState::kClosed);
}

TEST(DoorState, ALeafAtAnAngleIsAjar) {
  for (const double deg : {10.0, 18.0, 27.0})
    EXPECT_EQ(StateOf(kOpening, LeafAt(Radians(deg))).State(1), DoorState::kAjar) << deg;
}

TEST(DoorState, ALeafFarBehindAndARoomAreOpen) {
  EXPECT_EQ(StateOf(kOpening, LeafAt(Radians(80))).State(2), DoorState::kOpen);
  std::vector<SurfacePoint> room;
  for (double y = -0.3; y < 0.35; y += 0.1) room.push_back({{2.5 + y, y}, 0.05});
  EXPECT_EQ(StateOf(kOpening, room).State(2), DoorState::kOpen);
}

TEST(DoorState, WithoutSurfacesNothingIsSaid) {
  EXPECT_EQ(StateOf(kOpening, {}).State(2), DoorState::kUnknown);
}

TEST(DoorState, LooksAddUp) {
  DoorStateEvidence a;
  a.log_likelihood = {1.5, 0, 0};
  EXPECT_EQ(a.State(2), DoorState::kUnknown);
  a += a;
  EXPECT_EQ(a.State(2), DoorState::kClosed);
  EXPECT_DOUBLE_EQ(a.Lead(), 3);
}

}  // namespace
}  // namespace priamos::head
