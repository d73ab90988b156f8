#include "head/core/doors/line_cover.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

/// A level line from x to x, with its bright side above or below.
ViewLine Level(double from, double to, double y, bool bright_below) {
  ViewLine line;
  line.p = {from, y};
  line.q = {to, y};
  line.normal = {0, bright_below ? 1.0 : -1.0};
  line.length_px = to - from;
  line.plane.setZero();
  return line;
}

const ExpectedLine kExpected({100, 50}, {200, 50});

TEST(LineCover, GapsAndLinesBesideDoNotCount) {
  CameraView view;
  view.lines = {Level(90, 140, 50.5, true), Level(170, 180, 49, true), Level(100, 200, 54, true)};
  const Cover dut = CoverOf(view, kExpected);
  EXPECT_NEAR(dut.share, 0.5, 1e-9);
  EXPECT_NEAR(dut.first_px, -10, 1e-9);
  EXPECT_NEAR(dut.last_px, -20, 1e-9);
  EXPECT_EQ(dut.line, 0);
}

TEST(LineCover, OneContrastCountsUnlessItMayChange) {
  CameraView view;
  view.lines = {Level(100, 150, 50, true), Level(150, 190, 50, false)};
  EXPECT_NEAR(CoverOf(view, kExpected).share, 0.5, 1e-9);
  EXPECT_NEAR(CoverOfAnyContrast(view, kExpected).share, 0.9, 1e-9);
}

}  // namespace
}  // namespace priamos::head
