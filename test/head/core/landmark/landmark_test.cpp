#include "head/core/landmark/landmark.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

LandmarkEdge Edge(double from_rad, double to_rad) {
  return {{0, 0, 0}, {0, 0, 2}, from_rad, to_rad, 0};
}

TEST(LandmarkEdgeTest, SectorThatCrossesTheBackIsSeenFromBehindTheOrigin) {
  const LandmarkEdge dut = Edge(Radians(105), Radians(-105));
  EXPECT_TRUE(dut.IsSeenFrom({-3, 0}));
  EXPECT_TRUE(dut.IsSeenFrom({-3, 2}));
  EXPECT_FALSE(dut.IsSeenFrom({3, 0}));
  EXPECT_FALSE(dut.IsSeenFrom({-0.1, 3}));
}

TEST(LandmarkEdgeTest, PlainSector) {
  const LandmarkEdge dut = Edge(Radians(-30), Radians(20));
  EXPECT_TRUE(dut.IsSeenFrom({2, 0.5}));
  EXPECT_FALSE(dut.IsSeenFrom({2, 1}));
  EXPECT_FALSE(dut.IsSeenFrom({-2, 0}));
}

TEST(LandmarkEdgeTest, MarginWidensBothEnds) {
  const LandmarkEdge dut = Edge(Radians(-30), Radians(20));
  EXPECT_TRUE(dut.IsSeenFrom({2, 1}, Radians(10)));
  EXPECT_TRUE(dut.IsSeenFrom({2, -1.4}, Radians(10)));
  EXPECT_FALSE(dut.IsSeenFrom({-2, 0}, Radians(10)));
}

TEST(LandmarkEdgeTest, WholeCircleIsSeenFromEverywhere) {
  const LandmarkEdge dut = Edge(-kPi, kPi);
  for (int i = 0; i < 36; ++i) EXPECT_TRUE(dut.IsSeenFrom({std::cos(0.1 + i), std::sin(0.1 + i)}));
}

TEST(LandmarkEdgeTest, KnowsWhatIsVertical) {
  EXPECT_TRUE(Edge(0, 1).IsVertical());
  EXPECT_FALSE((LandmarkEdge{{0, 0, 2}, {0, 1, 2}, 0, 1, 0}).IsVertical());
}

}  // namespace
}  // namespace priamos::head
