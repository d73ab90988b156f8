#include "head/core/landmark/edge_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

class EdgeFieldTest : public testing::Test {
 protected:
  static CameraView ViewOf(const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    CameraView view;
    view.size = {400, 300};
    const double length_px = (q - p).norm();
    const Eigen::Vector2d normal = Eigen::Vector2d(p.y() - q.y(), q.x() - p.x()) / length_px;
    view.lines.push_back({.segment = 0,
                          .p = p,
                          .q = q,
                          .normal = normal,
                          .length_px = length_px,
                          .plane = Eigen::Vector4d::Zero(),
                          .contrast = 50});
    return view;
  }

  const FieldRegion region_{{0, 0}, {400, 300}};
};

TEST_F(EdgeFieldTest, ALineIsFeltOnItselfAndLessBesideIt) {
  const EdgeField dut(ViewOf({100, 100}, {250, 160}), region_, 6);
  double before = 1.1;
  for (const double beside : {0.0, 3.0, 6.0, 10.0}) {
    const Eigen::Vector2d shift = beside * Eigen::Vector2d(-60, 150).normalized();
    const double value = dut.Along(Eigen::Vector2d(110, 104) + shift, Eigen::Vector2d(240, 156) + shift);
    EXPECT_NEAR(value, std::exp(-beside * beside / 72), 0.08) << beside;
    EXPECT_LT(value, before);
    before = value;
  }
}

TEST_F(EdgeFieldTest, LinesOfAnotherDirectionAreNotFelt) {
  const EdgeField dut(ViewOf({100, 100}, {250, 100}), region_, 6);
  EXPECT_NEAR(dut.Along({175, 90}, {175, 110}), 0, 0.01);
  EXPECT_GT(dut.Along({240, 102}, {110, 98}), 0.9) << "either way along";
}

TEST_F(EdgeFieldTest, LinesOfEachDirectionAreFeltOnThemselves) {
  const Eigen::Vector2d middle(200, 150);
  for (int degrees = 0; degrees < 360; degrees += 4) {
    const double angle = Radians(degrees);
    const Eigen::Vector2d half = 100 * Eigen::Vector2d(std::cos(angle), std::sin(angle)),
                          across(-half.y(), half.x());
    const EdgeField dut(ViewOf(middle - half, middle + half), region_, 6);
    EXPECT_GT(dut.Along(middle - half, middle + half), 0.8) << degrees;
    EXPECT_LT(dut.Along(middle - across, middle + across), 0.1) << degrees;
  }
}

TEST_F(EdgeFieldTest, ALineThatLeavesTheRegionIsFeltInIt) {
  const EdgeField dut(ViewOf({100, 100}, {399, 100}), region_, 6);
  const double inside = dut.Along({300, 100}, {400, 100}), half = dut.Along({300, 100}, {500, 100});
  EXPECT_NEAR(half, inside / 2, 0.06);
  EXPECT_LT(dut.Along({401, 100}, {500, 100}), 0.01);
}

TEST_F(EdgeFieldTest, WhatEveryLineGetsDoesNotCount) {
  CameraView view = ViewOf({0, 0}, {400, 0});
  for (int y = 6; y < 300; y += 6) {
    view.lines.push_back(view.lines[0]);
    view.lines.back().p.y() = view.lines.back().q.y() = y;
  }
  const EdgeField dut(view, region_, 6);
  EXPECT_NEAR(dut.Along({50, 150}, {350, 150}), 0, 0.15);
}

TEST_F(EdgeFieldTest, OutsideOfTheRegionNothingRuns) {
  const EdgeField dut(ViewOf({-500, 150}, {900, 150}), region_, 6);
  EXPECT_LE(dut.Along({500, 150}, {800, 150}), 0);
  EXPECT_GT(dut.Along({50, 150}, {350, 150}), 0.8);
}

}  // namespace
}  // namespace priamos::head
