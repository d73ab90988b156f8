#include "world/core/render/lighting.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace priamos::world {
namespace {

using Eigen::Vector3d;

std::vector<Solid> OneBox(double yaw = 0) {
  return {{"box", {2, 0, yaw}, {1, 1}, 0, 1, "wood"}};
}

TEST(Lighting, DistanceIsToTheFirstSurface) {
  const Lighting dut({}, OneBox());
  EXPECT_NEAR(dut.Distance({0, 0, 0.5}, Vector3d::UnitX(), 10), 1.5, 1e-9);
  EXPECT_NEAR(dut.Distance({0, 0, 0.5}, -Vector3d::UnitX(), 10), 10, 1e-9) << "nothing there";
  EXPECT_NEAR(dut.Distance({0, 0, 1.5}, Vector3d::UnitX(), 10), 10, 1e-9) << "above the box";
  EXPECT_NEAR(dut.Distance({0, 0, 0.5}, -Vector3d::UnitZ(), 10), 0.5, 1e-9) << "floor";
  EXPECT_NEAR(dut.Distance({0, 0, 0.5}, Vector3d::UnitZ(), 10), 2.3, 1e-9) << "ceiling";
}

TEST(Lighting, DistanceKnowsTheYawOfABox) {
  const Lighting dut({}, OneBox(0.7853981633974483));
  EXPECT_NEAR(dut.Distance({0, 0, 0.5}, Vector3d::UnitX(), 10), 2 - std::sqrt(0.5), 1e-9);
}

TEST(Lighting, WhatFacesTheWindowsIsBrighter) {
  SceneConfig config;
  config.ambient = 0.4;
  config.window = 0.6;
  config.window_yaw_deg = 90;
  const Lighting dut(config, {});
  EXPECT_GT(dut.At({0, 0, 1}, Vector3d::UnitY()), 1.5 * dut.At({0, 0, 1}, -Vector3d::UnitY()));
}

TEST(Lighting, AShelfShadesTheLampsAbove) {
  SceneConfig config;
  config.ambient = config.window = 0;
  const std::vector<Solid> shelf = {{"shelf", {0, 0, 0}, {6, 6}, 1.5, 1.52, "wood"}};
  const double open = Lighting(config, {}).At({0, 0, 0.001}, Vector3d::UnitZ());
  EXPECT_GT(open, 0.3);
  EXPECT_LT(Lighting(config, shelf).At({0, 0, 0.001}, Vector3d::UnitZ()), 0.2 * open);
}

TEST(Lighting, CornersGetLessAmbientLight) {
  SceneConfig config;
  config.ambient = 1;
  config.window = 0;
  const Lighting dut(config, OneBox());
  const double beside_box = dut.At({1.45, 0, 0.001}, Vector3d::UnitZ());
  EXPECT_LT(beside_box, 0.85 * dut.At({-2, 0, 0.001}, Vector3d::UnitZ()));
}

TEST(Lighting, BrightnessScalesEverything) {
  SceneConfig config;
  const double normal = Lighting(config, OneBox()).At({0, 0, 1}, Vector3d::UnitX());
  config.brightness *= 1.5;
  EXPECT_NEAR(Lighting(config, OneBox()).At({0, 0, 1}, Vector3d::UnitX()), 1.5 * normal, 1e-9);
}

}  // namespace
}  // namespace priamos::world
