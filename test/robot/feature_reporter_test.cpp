#include "robot/feature_reporter.hpp"

#include <gtest/gtest.h>

namespace priamos::robot {
namespace {

TEST(FeatureMessage, AFeatureIsAWallAPointOrHasGone) {
  Feature wall, point, gone;
  wall.id = 4;
  wall.length_m = 1.5;
  gone.gone = true;
  const features_t dut = ToMessage({77, 3, {wall, point, gone}});
  EXPECT_EQ(dut.store, 77);
  EXPECT_EQ(dut.batch, 3);
  ASSERT_EQ(dut.features.size(), 3u);
  EXPECT_EQ(dut.features[0].id, 4);
  EXPECT_EQ(dut.features[0].kind, feature_t::WALL);
  EXPECT_EQ(dut.features[1].kind, feature_t::POINT);
  EXPECT_EQ(dut.features[2].kind, feature_t::GONE);
}

}  // namespace
}  // namespace priamos::robot
