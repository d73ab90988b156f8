#include "planner/core/path/passage_uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

constexpr DriftModel kNoDrift{.yaw_rad_per_sqrt_m = 0, .lateral_m_per_sqrt_m = 0, .yaw_bias_rad_per_m = 0};

TEST(PassageUncertainty, IndependentErrorsAddInQuadrature) {
  const DoorPlan door = ShippedPlan().doors[0];
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.5 * 0.5, 0.03 * 0.03, 0.02 * 0.02).asDiagonal();
  const auto dut = AtDoor(door, {4.0, 2.4, 0}, covariance, kNoDrift);
  EXPECT_NEAR(dut.lateral_sigma_m, std::hypot(0.03, 2 * 0.02), 1e-12);
  EXPECT_NEAR(dut.heading_sigma_rad, 0.02, 1e-12);
}

TEST(PassageUncertainty, IsTheSameForATurnedMap) {
  const Pose2 turned{3, -4, 2.1};
  const GroundPlan plan = ShippedPlan();
  Eigen::Matrix3d covariance;
  covariance << 4e-4, 1e-4, 2e-5, 1e-4, 9e-4, -3e-4, 2e-5, -3e-4, 2e-4;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = turned.rotation();
  const Pose2 base{3.5, 2.5, 0.1};
  const auto straight = AtDoor(plan.doors[0], base, covariance, {});
  const auto dut =
      AtDoor(Moved(plan, turned).doors[0], turned * base, turn * covariance * turn.transpose(), {});
  EXPECT_NEAR(dut.lateral_sigma_m, straight.lateral_sigma_m, 1e-9);
}

TEST(PassageUncertainty, MatchesASampledRobotThatFollowsItsBelief) {
  const DoorPlan door = ShippedPlan().doors[0];
  Rng rng(4);
  const double sigma_y = 0.02, sigma_yaw = 0.015, rho = -0.8;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance(1, 1) = sigma_y * sigma_y;
  covariance(2, 2) = sigma_yaw * sigma_yaw;
  covariance(1, 2) = covariance(2, 1) = rho * sigma_y * sigma_yaw;
  double sum = 0;
  constexpr int kRuns = 20000;
  for (int i = 0; i < kRuns; ++i) {
    const double a = rng.Normal(1), b = rng.Normal(1);
    const Pose2 truth{3.8, 2.4 + sigma_y * a, sigma_yaw * (rho * a + std::sqrt(1 - rho * rho) * b)};
    // It believes to stand at (3.8, 2.4, 0) and drives 2.2 m straight ahead.
    const double lateral = (truth * Eigen::Vector2d(2.2, 0)).y() - 2.4;
    sum += lateral * lateral;
  }
  EXPECT_NEAR(AtDoor(door, {3.8, 2.4, 0}, covariance, kNoDrift).lateral_sigma_m, std::sqrt(sum / kRuns),
              0.0004);
}

TEST(PassageUncertainty, DriftMatchesASampledDrive) {
  const DoorPlan door = ShippedPlan().doors[0];
  const DriftModel drift{
      .yaw_rad_per_sqrt_m = 0.0075, .lateral_m_per_sqrt_m = 0.005, .yaw_bias_rad_per_m = 0.003};
  Rng rng(8);
  constexpr int kRuns = 4000, kSteps = 200;
  constexpr double kWay_m = 2.0, kStep_m = kWay_m / kSteps;
  const double kept = std::exp(-kStep_m / drift.slip_length_m), fresh = std::sqrt(1 - kept * kept),
               stationary = 1 / std::sqrt(2 * drift.slip_length_m);
  double lateral_sum = 0, heading_sum = 0;
  for (int run = 0; run < kRuns; ++run) {
    double y = 0, yaw = 0;
    const double bias = rng.Normal(drift.yaw_bias_rad_per_m);
    // Slip per metre, a process of the same walk over long distances.
    double turn = rng.Normal(drift.yaw_rad_per_sqrt_m * stationary);
    double shift = rng.Normal(drift.lateral_m_per_sqrt_m * stationary);
    for (int i = 0; i < kSteps; ++i) {
      yaw += (turn + bias) * kStep_m;
      y += (yaw + shift) * kStep_m;
      turn = kept * turn + rng.Normal(drift.yaw_rad_per_sqrt_m * stationary * fresh);
      shift = kept * shift + rng.Normal(drift.lateral_m_per_sqrt_m * stationary * fresh);
    }
    lateral_sum += y * y;
    heading_sum += yaw * yaw;
  }
  const auto dut = AtDoor(door, {4.0, 2.4, 0}, Eigen::Matrix3d::Zero(), drift);
  EXPECT_NEAR(dut.lateral_sigma_m, std::sqrt(lateral_sum / kRuns), 0.05 * dut.lateral_sigma_m);
  EXPECT_NEAR(dut.heading_sigma_rad, std::sqrt(heading_sum / kRuns), 0.05 * dut.heading_sigma_rad);
}

TEST(PassageUncertainty, AConstantTurnLeadsOffTheAxisByHalfTheSquareOfTheDistance) {
  const DoorPlan door = ShippedPlan().doors[0];
  const auto dut = AtDoor(door, {4.0, 2.4, 0}, Eigen::Matrix3d::Zero(),
                          {.yaw_rad_per_sqrt_m = 0, .lateral_m_per_sqrt_m = 0, .yaw_bias_rad_per_m = 0.003});
  EXPECT_NEAR(dut.lateral_sigma_m, 0.003 * 2 * 2 / 2, 1e-12);
  EXPECT_NEAR(dut.heading_sigma_rad, 0.003 * 2, 1e-12);
}

TEST(PassageUncertainty, PerfectFixFromAfarIsNotGoodEnoughFromNearItIs) {
  const DoorPlan door = ShippedPlan().doors[0];
  const auto gap = [&](double way_m) {
    return GapLeft(door, Footprint{}, AtDoor(door, {6 - way_m, 2.4, 0}, Eigen::Matrix3d::Zero(), {}), 0.005);
  };
  EXPECT_LT(gap(3.0), 0);
  EXPECT_GT(gap(1.5), 0.02);
}

TEST(PassageUncertainty, CertainRobotHasSixCentimetres) {
  EXPECT_NEAR(GapLeft(DoorPlan{}, Footprint{}, {}, 0), 0.06, 1e-12);
  EXPECT_NEAR(GapLeft(DoorPlan{}, Footprint{}, {}, 0.005), 0.055, 1e-12);
}

TEST(PassageUncertainty, ErrorsOfThePaperBeforeTheFixDoNotFit) {
  EXPECT_LT(GapLeft(DoorPlan{}, Footprint{}, {0.10, Radians(2.5)}, 0.005), 0);
}

TEST(PassageUncertainty, TwoCentimetresAndHalfADegreeFit) {
  EXPECT_GT(GapLeft(DoorPlan{}, Footprint{}, {0.01, Radians(0.25)}, 0.005), 0.02);
}

}  // namespace
}  // namespace priamos::planner
