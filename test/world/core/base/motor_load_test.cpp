#include "world/core/base/motor_load.hpp"

#include <gtest/gtest.h>

namespace priamos::world {
namespace {

constexpr double kStep = 0.0025, kNewton = 180 * 9.81 / 4;

/// Without errors of the sensors and of the mass.
MotorLoadConfig Exact() {
  return {.mass_error = 0, .noise_a = 0, .offset_a = 0};
}

/// Currents after `seconds`, in which the wheels accelerate evenly from `speed` and slide at `slide`.
PerWheel CurrentsAfter(double seconds, double speed, double acceleration, double slide,
                       const MotorLoadConfig& config = Exact()) {
  MotorLoad dut(config, Rng(1));
  PerWheel rolled;
  rolled.fill(speed);
  dut.Step(rolled, {}, 1);  // as it was before
  for (double t = 0; t < seconds; t += kStep) {
    for (double& r : rolled) r += acceleration * kStep;
    PerWheel slid;
    slid.fill(slide);
    dut.Step(rolled, slid, kStep);
  }
  return dut.Read();
}

TEST(MotorLoad, AtAnEvenSpeedTheWheelsOvercomeTheirRollingResistance) {
  for (const double current : CurrentsAfter(0.2, 0.3, 0, 0)) EXPECT_NEAR(current, 0.015 * kNewton / 20, 0.01);
  for (const double current : CurrentsAfter(0.2, -0.3, 0, 0))
    EXPECT_NEAR(current, -0.015 * kNewton / 20, 0.01);
}

TEST(MotorLoad, AccelerationTakesTheForceOfTheMass) {
  for (const double current : CurrentsAfter(0.2, 0.1, 1.0, 0))
    EXPECT_NEAR(current, (45 * 1.0 + 0.015 * kNewton) / 20, 0.05);
}

TEST(MotorLoad, AWheelThatSlidesPushesAsTheFloorLetsIt) {
  for (const double current : CurrentsAfter(0.2, 0.3, 0, 0.3))
    EXPECT_NEAR(current, (0.6 + 0.015) * kNewton / 20, 0.05);
  for (const double current : CurrentsAfter(0.2, 0.005, 0, 0.005))
    EXPECT_NEAR(current, (0.6 / 4 + 0.015) * kNewton / 20, 0.05) << "a quarter of the sliding speed";
}

TEST(MotorLoad, NoWheelPushesMoreThanTheFloorTakes) {
  for (const double current : CurrentsAfter(0.05, 0, 30, 0)) EXPECT_LT(current, 0.62 * kNewton / 20);
}

TEST(MotorLoad, ReadingsAreOffAndNoisyAndTheMassIsDrawnFromTheSeed) {
  MotorLoad a(MotorLoadConfig{}, Rng(1)), b(MotorLoadConfig{}, Rng(2));
  const PerWheel first = a.Read(), second = a.Read(), other = b.Read();
  EXPECT_NE(first, second);
  EXPECT_NE(first, other);
  for (const double current : first) EXPECT_LT(std::abs(current), 0.2 + 5 * 0.3);
}

}  // namespace
}  // namespace priamos::world
