#include "head/core/calibration/discs/bright_regions.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

constexpr int kWidth = 60, kHeight = 40, kContrast = 20;

class BrightRegions : public testing::Test {
 protected:
  /// Adds `levels` to the pixels of a rectangle, ends included.
  void Brighten(int u0, int u1, int v0, int v1, int levels) {
    for (int v = v0; v <= v1; ++v)
      for (int u = u0; u <= u1; ++u) image_.pixels[v * kWidth + u] += static_cast<std::uint8_t>(levels);
  }
  std::vector<BrightRegion> Find() const { return FindBrightRegions(image_, kContrast); }

  GreyImage image_{kWidth, kHeight, std::vector<std::uint8_t>(kWidth* kHeight, 50)};
};

TEST_F(BrightRegions, ARectangleIsItsOwnBox) {
  Brighten(10, 19, 8, 16, 100);
  const auto dut = Find();
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_EQ(dut[0].u_min, 10);
  EXPECT_EQ(dut[0].u_max, 19);
  EXPECT_EQ(dut[0].v_min, 8);
  EXPECT_EQ(dut[0].v_max, 16);
  EXPECT_EQ(dut[0].width(), 10);
  EXPECT_EQ(dut[0].height(), 9);
  EXPECT_EQ(dut[0].pixels, 5 * 10);  // of rows 8, 10, 12, 14, 16
}

TEST_F(BrightRegions, OnlyWhatStandsOutByTheContrastCounts) {
  Brighten(10, 19, 8, 16, kContrast - 2);
  EXPECT_TRUE(Find().empty());
  Brighten(10, 19, 8, 16, 6);
  EXPECT_EQ(Find().size(), 1u);
}

TEST_F(BrightRegions, SpotsThatDoNotTouchAreApart) {
  Brighten(10, 14, 10, 20, 100);
  Brighten(16, 20, 10, 20, 100);  // a dark column between them
  Brighten(10, 20, 24, 30, 100);  // below, two read rows between
  const auto dut = Find();
  ASSERT_EQ(dut.size(), 3u);
  EXPECT_EQ(std::count_if(dut.begin(), dut.end(), [](const auto& r) { return r.width() == 5; }), 2);
}

TEST_F(BrightRegions, ArmsThatMeetLaterAreOneRegion) {
  Brighten(10, 14, 4, 19, 100);  // a U
  Brighten(30, 34, 4, 19, 100);
  Brighten(10, 34, 20, 24, 100);
  Brighten(50, 52, 4, 30, 100);
  const auto dut = Find();
  ASSERT_EQ(dut.size(), 2u);
  const auto& u = dut[0].width() > 10 ? dut[0] : dut[1];
  EXPECT_EQ(u.u_min, 10);
  EXPECT_EQ(u.u_max, 34);
  EXPECT_EQ(u.v_min, 4);
  EXPECT_EQ(u.v_max, 24);
  EXPECT_EQ(u.pixels, 8 * 10 + 3 * 25);  // rows 4 to 18, and 20, 22, 24
}

TEST_F(BrightRegions, AGentleSlopeIsGround) {
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) image_.pixels[v * kWidth + u] = static_cast<std::uint8_t>(40 + u);
  EXPECT_TRUE(Find().empty());
  Brighten(30, 39, 8, 16, 80);
  const auto dut = Find();
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_EQ(dut[0].u_min, 30);
  EXPECT_EQ(dut[0].u_max, 39);
}

TEST_F(BrightRegions, WhatIsBrightFromTheLeftBorderOnDoesNotStandOut) {
  Brighten(0, 9, 8, 16, 100);
  EXPECT_TRUE(Find().empty());
}

TEST_F(BrightRegions, DarkSpotsAreNone) {
  Brighten(0, kWidth - 1, 0, kHeight - 1, 100);
  for (int v = 10; v < 20; ++v)
    for (int u = 20; u < 30; ++u) image_.pixels[v * kWidth + u] = 20;
  for (const BrightRegion& r : Find()) EXPECT_EQ(r.u_max, kWidth - 1) << "what lies right of the dark spot";
}

TEST_F(BrightRegions, AnEmptyImageHasNone) {
  EXPECT_TRUE(FindBrightRegions(GreyImage{}, kContrast).empty());
  EXPECT_TRUE(Find().empty());
}

bool SameBoxes(const std::vector<BrightRegion>& a, const std::vector<BrightRegion>& b) {
  return std::ranges::equal(a, b, [](const BrightRegion& x, const BrightRegion& y) {
    return x.u_min == y.u_min && x.u_max == y.u_max && x.v_min == y.v_min && x.v_max == y.v_max &&
           x.pixels == y.pixels;
  });
}

/// Spots at random places before a flat ground.
GreyImage Spots(Rng& rng, int ground) {
  GreyImage image{kWidth, kHeight, std::vector<std::uint8_t>(kWidth * kHeight, std::uint8_t(ground))};
  for (int i = 0; i < 6; ++i) {
    const int u0 = 2 + static_cast<int>(rng.Below(50)), v0 = static_cast<int>(rng.Below(33));
    const int width = 2 + static_cast<int>(rng.Below(6)), height = 2 + static_cast<int>(rng.Below(6));
    for (int v = v0; v < v0 + height; ++v)
      for (int u = u0; u < u0 + width; ++u)
        image.pixels[v * kWidth + u] = static_cast<std::uint8_t>(ground + 60);
  }
  return image;
}

RC_GTEST_PROP(BrightRegionsLaw, TheBrightnessOfTheImageAsAWholeDoesNotMatter, ()) {
  const int seed = *rc::gen::inRange(0, 100000);
  Rng dark_rng(seed), bright_rng(seed);
  RC_ASSERT(SameBoxes(FindBrightRegions(Spots(dark_rng, 5), kContrast),
                      FindBrightRegions(Spots(bright_rng, 190), kContrast)));
}

RC_GTEST_PROP(BrightRegionsLaw, EveryBrightPixelOfTheRowsThatAreReadIsCountedOnce, ()) {
  Rng rng = support::GeneratedRng();
  const GreyImage image = Spots(rng, 30);
  int bright = 0, counted = 0;
  for (int v = 0; v < kHeight; v += 2)
    for (int u = 0; u < kWidth; ++u) bright += image.pixels[v * kWidth + u] > 60;
  for (const BrightRegion& r : FindBrightRegions(image, kContrast)) {
    counted += r.pixels;
    RC_ASSERT(r.pixels <= r.width() * (r.height() / 2 + 1));
  }
  RC_ASSERT(counted == bright);
}

}  // namespace
}  // namespace priamos::head
