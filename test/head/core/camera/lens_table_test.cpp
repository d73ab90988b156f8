#include "head/core/camera/lens_table.hpp"

#include <gmock/gmock.h>

namespace priamos::head {
namespace {

/// Smooth in both directions, as lenses are.
LensState Lens(double zoom, double focus) {
  const double z = zoom / 2000, f = focus / 2000;
  return {
      800 * std::pow(2, z) * (1 + 0.01 * f), {380 + 3 * z * z, 290 - 2 * z}, -0.07 + 0.05 * z, 0.01, 0.02};
}

LensTable Table() {
  const std::vector<int> zoom{0, 400, 800, 1200, 1600}, focus{1000, 1500, 2000};
  std::vector<LensState> nodes;
  for (const int z : zoom)
    for (const int f : focus) nodes.push_back(Lens(z, f));
  return LensTable(zoom, focus, nodes);
}

TEST(LensTable, KeepsItsNodes) {
  const auto dut = Table().At(800, 1500);
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->focal_px, Lens(800, 1500).focal_px, 1e-9);
}

TEST(LensTable, InterpolatesBetweenNodes) {
  for (const double zoom : {50.0, 333.0, 1000.0, 1590.0}) {
    for (const double focus : {1000.0, 1250.0, 1999.0}) {
      const auto dut = Table().At(zoom, focus);
      ASSERT_TRUE(dut);
      EXPECT_NEAR(dut->focal_px, Lens(zoom, focus).focal_px, 0.01) << zoom << " " << focus;
      EXPECT_NEAR(dut->centre_px.x(), Lens(zoom, focus).centre_px.x(), 1e-9);
    }
  }
}

TEST(LensTable, RefusesWhatWasNotCalibrated) {
  EXPECT_THAT(Table().At(-2, 1500).reason(), testing::HasSubstr("zoom -2 is outside"));
  EXPECT_THAT(Table().At(800, 2002).reason(), testing::HasSubstr("focus 2002 is outside"));
  EXPECT_FALSE(Table().At(std::nan(""), 1500));
  EXPECT_FALSE(LensTable().At(0, 0));
}

TEST(LensTable, ASingleNodeIsThereForItsSettingOnly) {
  const LensTable dut({650}, {1600}, {Lens(650, 1600)});
  EXPECT_TRUE(dut.At(651, 1600));
  EXPECT_FALSE(dut.At(660, 1600));
}

TEST(LensTable, RefusesGridsThatDoNotFit) {
  EXPECT_THROW(LensTable({0, 0}, {1}, {LensState{}, LensState{}}), std::invalid_argument);
  EXPECT_THROW(LensTable({0, 1}, {1}, {LensState{}}), std::invalid_argument);
}

}  // namespace
}  // namespace priamos::head
