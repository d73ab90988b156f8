#include "world/core/scene/world_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "common/config.hpp"
#include "common/config_printer.hpp"
#include "world/core/camera/optics.hpp"

namespace priamos::world {
namespace {

TEST(DrawStartTest, TheTruthFillsTheDiscEvenlyAndNeverLeavesIt) {
  StartPlan plan;
  plan.x_m = 2;
  plan.y_m = 2.4;
  int inner = 0;
  double left = 0, largest_turn = 0;
  const int n = 2000;
  for (int seed = 0; seed < n; ++seed) {
    const Start dut = DrawStart(plan, static_cast<std::uint64_t>(seed));
    EXPECT_EQ(dut.nominal.x, 2);
    const double off = std::hypot(dut.truth.x - 2, dut.truth.y - 2.4);
    EXPECT_LE(off, 0.2);
    inner += off < 0.1;
    left += dut.truth.y > 2.4;
    largest_turn = std::max(largest_turn, std::abs(Degrees(dut.truth.yaw)));
  }
  // A quarter of the disc's area lies within half its radius.
  EXPECT_NEAR(inner / double(n), 0.25, 0.03);
  EXPECT_NEAR(left / n, 0.5, 0.04);
  EXPECT_LE(largest_turn, 5);
  EXPECT_GT(largest_turn, 4.9);
}

TEST(DrawStartTest, SpreadMovesTheNominalPoseToo) {
  StartPlan plan;
  plan.x_spread_m = 1;
  double low = 1, high = -1;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Start dut = DrawStart(plan, seed);
    EXPECT_LE(std::hypot(dut.truth.x - dut.nominal.x, dut.truth.y - dut.nominal.y), 0.2);
    low = std::min(low, dut.nominal.x);
    high = std::max(high, dut.nominal.x);
  }
  EXPECT_LT(low, -0.9);
  EXPECT_GT(high, 0.9);
}

TEST(PlaceReferenceTest, StandsBeforeTheRobotAndFacesIt) {
  ReferencePlan plan;
  plan.error_m = plan.error_deg = 0;
  const auto dut = PlaceReference(plan, ReferenceObject{}, {1, 2, kPi / 2}, 1);
  const Eigen::Vector3d at = dut.map_from_object.translation();
  EXPECT_NEAR(at.x(), 1, 1e-12);
  EXPECT_NEAR(at.y(), 3.75, 1e-12);
  EXPECT_NEAR(at.z(), 1.2, 1e-12);
  EXPECT_TRUE(dut.map_from_object.linear().col(0).isApprox(Eigen::Vector3d(0, -1, 0), 1e-9));
}

TEST(PlaceReferenceTest, TheErrorIsAsSmallAsConfiguredButNotZero) {
  const ReferencePlan plan;
  ReferencePlan exact;
  exact.error_m = exact.error_deg = 0;
  const auto ideal = PlaceReference(exact, {}, {}, 1).map_from_object;
  double squares = 0, turns = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Eigen::Isometry3d error = ideal.inverse() * PlaceReference(plan, {}, {}, seed).map_from_object;
    squares += error.translation().squaredNorm() / 3 / 300;
    turns += std::pow(Degrees(Eigen::AngleAxisd(error.linear()).angle()), 2) / 3 / 300;
  }
  EXPECT_NEAR(std::sqrt(squares), 0.0005, 0.0001);
  EXPECT_NEAR(std::sqrt(turns), 0.05, 0.01);
}

TEST(DrawLightTest, StaysWithinItsSpread) {
  WorldPlan plan;
  plan.brightness_spread = 0.2;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    EXPECT_NEAR(DrawLight(plan, seed).brightness, plan.light.brightness, 0.2 * plan.light.brightness);
  EXPECT_NE(DrawLight(plan, 1).brightness, DrawLight(plan, 2).brightness);
}

TEST(WorldPlanTest, PrintedConfigReadsBack) {
  WorldPlan plan;
  plan.doors.resize(1);
  plan.boxes.resize(2);
  plan.boxes[1].name = "shelf";
  std::ostringstream printed;
  PrintConfig(printed, plan);
  const auto dut = ParseConfig<WorldPlan>("printed", printed.str());
  ASSERT_EQ(dut.boxes.size(), 2u);
  EXPECT_EQ(dut.boxes[1].name, "shelf");
  EXPECT_EQ(dut.start.error_m, 0.2);
}

TEST(WorldPlanTest, AWrongValueIsNamedWithItsPlace) {
  try {
    ParseConfig<WorldPlan>("w.toml", "[[doors]]\nid = 1\nhinge = \"middle\"");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "w.toml:3:doors[0].hinge: expected one of left, right, got \"middle\"");
  }
}

}  // namespace
}  // namespace priamos::world
