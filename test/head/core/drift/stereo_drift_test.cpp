#include "head/core/drift/stereo_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "head/core/drift/drift_monitor.hpp"
#include "test/support/drift_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector3d;
using test::DriftScene;

constexpr DriftScene::Errors kNone{0, 0, 0, 0, 0.001};

Pose2 SomePose(Rng& rng, double nearest_m) {
  return {rng.Uniform(nearest_m, 4.0), rng.Uniform(-0.15, 0.15), rng.Uniform(-0.08, 0.08)};
}

std::optional<StereoDrift> Measure(const DriftScene& scene, Rng& rng, double nearest_m = 2.4) {
  const Pose2 pose = SomePose(rng, nearest_m);
  // A fix is so exact.
  const Pose2 found{pose.x + rng.Normal(0.003), pose.y + rng.Normal(0.001), pose.yaw + rng.Normal(0.001)};
  return MeasureDrift(scene.model(), scene.Look(pose, rng), scene.camera(0), scene.camera(1), Lift(found));
}

TEST(StereoDriftTest, MeasuresTheTurnThatThereIs) {
  Rng rng(1);
  for (int axis = 0; axis < 3; ++axis) {
    DriftScene scene(kNone, rng);
    Vector3d turn = Vector3d::Zero();
    turn(axis) = 0.001;
    scene.TurnRight(turn);
    for (int i = 0; i < 5; ++i) {
      const auto dut = Measure(scene, rng);
      ASSERT_TRUE(dut);
      EXPECT_LT((dut->turn_rad - turn).norm(), 3e-5) << dut->turn_rad.transpose();
    }
  }
}

TEST(StereoDriftTest, MeasuresATurnOfManyPixelsAsWell) {
  Rng rng(9);
  for (int axis = 0; axis < 3; ++axis) {
    DriftScene scene(kNone, rng);
    Vector3d turn = Vector3d::Zero();
    turn(axis) = 0.01;  // nine pixels: no residual is small before the first solution
    scene.TurnRight(turn);
    const auto dut = Measure(scene, rng);
    ASSERT_TRUE(dut);
    EXPECT_LT((dut->turn_rad - turn).norm(), 3e-4) << dut->turn_rad.transpose();
  }
}

TEST(StereoDriftTest, ItsCovarianceIsHonest) {
  Rng rng(2);
  Vector3d squares = Vector3d::Zero();
  constexpr int kRuns = 150;
  for (int i = 0; i < kRuns; ++i) {
    const DriftScene scene({}, rng);
    const auto dut = Measure(scene, rng);
    ASSERT_TRUE(dut);
    squares += dut->turn_rad.cwiseAbs2().cwiseQuotient(dut->covariance.diagonal()) / kRuns;
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(squares(axis), 1.3) << axis;
    EXPECT_GT(squares(axis), 0.4) << axis;
  }
}

TEST(StereoDriftTest, TooFewEdgesSayNothing) {
  Rng rng(3);
  const DriftScene scene({}, rng);
  auto observations = scene.Look({3, 0, 0}, rng);
  EXPECT_FALSE(MeasureDrift(scene.model(), {}, scene.camera(0), scene.camera(1), Lift({3, 0, 0})));
  std::erase_if(observations, [](const EdgeObservation& o) { return o.camera == 1; });
  EXPECT_FALSE(MeasureDrift(scene.model(), observations, scene.camera(0), scene.camera(1), Lift({3, 0, 0})));
}

/// Whether a few looks before one door, with errors that stay the same, raise the alarm.
bool Alarms(const DriftConfig& config, const Vector3d& turn_rad, Rng& rng, double nearest_m) {
  DriftScene scene({}, rng);
  scene.TurnRight(turn_rad);
  DriftMonitor dut(config);
  for (int look = 0; look < config.looks; ++look) {
    const auto drift = Measure(scene, rng, nearest_m);
    if (drift) dut.Add(*drift);
  }
  return dut.alarm().has_value();
}

int CountAlarms(const DriftConfig& config, const Vector3d& turn_rad, int runs, std::uint64_t seed,
                double nearest_m = 2.4) {
  Rng rng(seed);
  int alarms = 0;
  for (int i = 0; i < runs; ++i) alarms += Alarms(config, turn_rad, rng, nearest_m);
  return alarms;
}

TEST(DriftMonitorTest, NoFalseAlarms) {
  // At 1 % the promise is worth counting: 2 expected at most in 200, more than 7 in one of 1000 such tests.
  DriftConfig config;
  config.false_alarm = 0.01;
  EXPECT_LE(CountAlarms(config, Vector3d::Zero(), 200, 4), 7);
  EXPECT_EQ(CountAlarms({}, Vector3d::Zero(), 50, 5), 0);
}

TEST(DriftMonitorTest, ATurnOfAPixelIsNoticed) {
  const double pixel = 1.0 / 900;
  // From 3 m on the lintel is in the picture: without a level edge nothing tells up from down.
  EXPECT_GE(CountAlarms({}, {pixel, 0, 0}, 20, 6, 3.0), 19);
  EXPECT_GE(CountAlarms({}, {0, pixel, 0}, 20, 7), 19);
}

TEST(DriftMonitorTest, VergenceOf0Point05DegreesIsNoticed) {
  EXPECT_GE(CountAlarms({}, {0, Radians(0.05), 0}, 40, 8), 30);
}

}  // namespace
}  // namespace priamos::head
