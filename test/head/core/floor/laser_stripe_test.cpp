#include "head/core/floor/laser_stripe.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry.hpp"
#include "test/support/calibration_scene.hpp"
#include "test/support/stripe_renderer.hpp"

namespace priamos::head {
namespace {

/// A camera 1.2 m above a floor, looking 30 degrees down; a fan of light from 0.6 m.
support::StripeScene Floor(double lean_rad = 0) {
  support::CameraView view;
  view.focal_px = 900;
  view.distance_m = 2.4;
  view.elevation_rad = Radians(30);
  view.target_m = {0, 0, 0};
  view.k1 = -0.05;
  support::StripeScene scene;
  scene.camera = support::MakeCamera(view);
  const Eigen::Vector3d normal = Eigen::AngleAxisd(lean_rad, Eigen::Vector3d::UnitX()) *
                                 Eigen::Vector3d(std::sin(0.35), 0, std::cos(0.35)).normalized();
  scene.laser = support::Plane(normal, Eigen::Vector3d::Zero());
  scene.board = support::Plane(Eigen::Vector3d::UnitZ(), 0);
  return scene;
}

struct Errors {
  int points = 0;
  double rms_px = 0, nees = 0;
};

Errors Measure(const support::StripeScene& scene, int images) {
  Rng rng(17);
  StripeFinder dut;
  Errors e;
  for (int i = 0; i < images; ++i) {
    for (const StripePoint& p : dut.Find(support::Render(scene, rng))) {
      const double error = p.at.y() - support::StripeRow(scene, p.at.x());
      e.rms_px += error * error;
      e.nees += std::pow(error / p.sigma_px, 2);
      ++e.points;
    }
  }
  e.rms_px = std::sqrt(e.rms_px / e.points);
  e.nees /= e.points;
  return e;
}

TEST(LaserStripeTest, EveryColumnToATenthOfAPixel) {
  const Errors e = Measure(Floor(), 2);
  EXPECT_GT(e.points, 2 * 760);
  EXPECT_LT(e.rms_px, 0.05);
}

TEST(LaserStripeTest, TellsHowWellItKnows) {
  for (const double noise : {1.0, 3.0, 6.0}) {
    support::StripeScene scene = Floor();
    scene.noise = noise;
    const Errors e = Measure(scene, 2);
    EXPECT_GT(e.nees, 0.7) << noise;
    EXPECT_LT(e.nees, 1.4) << noise;
  }
}

TEST(LaserStripeTest, ASlantedLineOnASlopingGround) {
  support::StripeScene scene = Floor(0.12);
  scene.slope_per_px = 0.15;
  const Errors e = Measure(scene, 2);
  EXPECT_GT(e.points, 2 * 700);
  EXPECT_LT(e.rms_px, 0.06);
}

TEST(LaserStripeTest, NoLaserNoLine) {
  support::StripeScene scene = Floor();
  scene.amplitude = 0;
  scene.noise = 6;
  Rng rng(4);
  StripeFinder dut;
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(dut.Find(support::Render(scene, rng)).empty());
}

TEST(LaserStripeTest, AnEdgeIsNoLine) {
  GreyImage image{200, 200, std::vector<std::uint8_t>(200 * 200, 20)};
  std::fill(image.pixels.begin() + 100 * 200, image.pixels.end(), 220);
  EXPECT_TRUE(StripeFinder().Find(image).empty());
}

TEST(LaserStripeTest, ImagesOfAnySizeAreSurvived) {
  for (const auto& [width, height] : {std::pair(0, 0), std::pair(1, 1), std::pair(3, 19), std::pair(3, 20),
                                      std::pair(2, 600), std::pair(64, 3000)}) {
    const GreyImage image{width, height, std::vector<std::uint8_t>(std::size_t(width) * height, 255)};
    EXPECT_TRUE(StripeFinder().Find(image).empty());
  }
}

TEST(LaserStripeTest, AnyReachStaysWithinTheImage) {
  Rng rng(9);
  for (int i = 0; i < 400; ++i) {
    const int width = static_cast<int>(rng.Below(40)), height = static_cast<int>(rng.Below(60));
    GreyImage image{width, height, std::vector<std::uint8_t>(std::size_t(width) * height)};
    for (auto& p : image.pixels) p = static_cast<std::uint8_t>(rng.Below(256));
    StripeOptions options;
    options.reach_px = 1 + static_cast<int>(rng.Below(9));
    options.min_length_px = 1;
    for (const StripePoint& p : StripeFinder(options).Find(image)) {
      EXPECT_GE(p.at.y(), 0);
      EXPECT_LE(p.at.y(), height - 1);
    }
  }
}

TEST(LaserStripeTest, ATallImageKeepsItsRows) {
  GreyImage image{40, 3000, std::vector<std::uint8_t>(40 * 3000, 10)};
  for (int u = 0; u < 40; ++u) {
    for (int v = 2799; v <= 2801; ++v) image.pixels[v * 40 + u] = v == 2800 ? 200 : 100;
  }
  const auto points = StripeFinder().Find(image);
  ASSERT_EQ(points.size(), 40u);
  EXPECT_NEAR(points[7].at.y(), 2800, 0.01);
}

/// Columns from `first` on get a ridge of three rows around `row`, on a ground of 40.
void DrawRidge(GreyImage& image, int first, int last, int row, int grey) {
  for (int u = first; u <= last; ++u) {
    for (int v = row - 1; v <= row + 1; ++v)
      image.pixels[static_cast<std::size_t>(v) * image.width + u] = static_cast<std::uint8_t>(grey);
  }
}
GreyImage Plain(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(std::size_t(width) * height, 40)};
}

/// Where the line is hidden: the rim of a box, brighter than the floor and hardly brighter than its top.
TEST(LaserStripeTest, AFaintRidgeWhereTheLineIsHiddenIsLeftOut) {
  GreyImage image = Plain(200, 100);
  DrawRidge(image, 0, 119, 50, 160);
  DrawRidge(image, 120, 199, 45, 65);
  for (const StripePoint& p : StripeFinder().Find(image)) EXPECT_LT(p.at.x(), 120);
  DrawRidge(image, 120, 199, 45, 90);
  EXPECT_GT(StripeFinder().Find(image).back().at.x(), 190) << "as bright as the line on something dark";
}

TEST(LaserStripeTest, TwoLinesComeFromTheTopWhereBothAreSeen) {
  GreyImage image = Plain(200, 300);
  DrawRidge(image, 0, 199, 200, 160);
  DrawRidge(image, 40, 199, 90, 110);
  const auto dut = StripeFinder().FindInOrder(image, 2);
  ASSERT_EQ(dut.size(), 2U);
  ASSERT_FALSE(dut[0].empty());
  EXPECT_EQ(dut[0].front().at.x(), 40) << "a column with one of them tells nothing";
  EXPECT_NEAR(dut[0].front().at.y(), 90, 0.1);
  EXPECT_EQ(dut[1].size(), dut[0].size());
  EXPECT_NEAR(dut[1].front().at.y(), 200, 0.1);
}

/// Wherever two ridges lie, also where slabs of rows meet.
TEST(LaserStripeTest, NoRidgeIsFoundTwice) {
  for (int row = 20; row < 140; ++row) {
    GreyImage image = Plain(3, 200);
    DrawRidge(image, 0, 2, row, 160);
    DrawRidge(image, 0, 2, row + 30, 120);
    const auto dut = StripeFinder().Ridges(image, 2);
    ASSERT_EQ(dut.size(), 6U) << row;
    EXPECT_NEAR(dut[0].at.y(), row, 0.1);
    EXPECT_NEAR(dut[1].at.y(), row + 30, 0.1);
  }
}

}  // namespace
}  // namespace priamos::head
