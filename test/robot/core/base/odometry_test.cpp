#include "robot/core/base/odometry.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "common/random.hpp"

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;

const MecanumGeometry kGeometry{.wheel_radius_m = 0.1, .lever_m = 0.5, .max_wheel_rad_s = 10};
constexpr Time kStart = FromUtime(1'000'000'000);

/// Four encoders on wheels that roll without slip.
class Wheels {
 public:
  explicit Wheels(std::int32_t first_tick = 0) : base_(first_tick) {}

  WheelSample Roll(const Twist2& twist, milliseconds time) {
    const WheelSpeeds speeds = ToWheelSpeeds(kGeometry, twist);
    now_ += time;
    for (std::size_t i = 0; i < 4; ++i) turned_[i] += speeds[i] * Seconds(time);
    return Sample();
  }
  WheelSample Sample() const {
    WheelSample sample{.time = now_};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto ticks = static_cast<std::int64_t>(std::floor(turned_[i] / (2 * kPi) * 4096));
      sample.ticks[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(ticks + base_));
    }
    return sample;
  }

 private:
  Time now_ = kStart;
  std::int64_t base_;
  std::array<double, 4> turned_{};
};

class OdometryTest : public testing::Test {
 protected:
  std::optional<OdometryStep> Add(const WheelSample& sample) { return dut_.Add(sample, sample.time); }
  void Drive(Wheels& wheels, const Twist2& twist, int samples) {
    for (int i = 0; i < samples; ++i) Add(wheels.Roll(twist, milliseconds(20)));
  }

  Odometry dut_{OdometryConfig{}, kGeometry};
};

TEST_F(OdometryTest, StandsAtTheOriginBeforeTheSecondSample) {
  EXPECT_FALSE(dut_.time());
  EXPECT_FALSE(Add(Wheels().Sample()));
  EXPECT_EQ(dut_.time(), kStart);
  EXPECT_EQ(dut_.pose().x, 0);
  EXPECT_EQ(dut_.twist().vx, 0);
}

TEST_F(OdometryTest, FollowsAnArcExactlyDownToOneTick) {
  Wheels wheels;
  Add(wheels.Sample());
  const Twist2 twist{0.4, 0.1, 0.5};
  Drive(wheels, twist, 200);
  const Pose2 expected = Integrate({}, twist, 4);
  EXPECT_NEAR(dut_.pose().x, expected.x, 5e-4);
  EXPECT_NEAR(dut_.pose().y, expected.y, 5e-4);
  EXPECT_NEAR(dut_.pose().yaw, expected.yaw, 5e-4);
  EXPECT_NEAR(dut_.twist().vx, 0.4, 0.01);
}

TEST_F(OdometryTest, CountersMayWrap) {
  Wheels wheels(std::numeric_limits<std::int32_t>::max() - 1000);
  Add(wheels.Sample());
  Drive(wheels, {0.5, 0, 0}, 100);
  EXPECT_NEAR(dut_.pose().x, 1, 1e-3);
  EXPECT_EQ(dut_.counters().jumps, 0);
}

TEST_F(OdometryTest, LostSamplesCostNoDistance) {
  Wheels wheels;
  Add(wheels.Sample());
  for (int i = 0; i < 49; ++i) wheels.Roll({0.5, 0, 0}, milliseconds(20));
  Add(wheels.Roll({0.5, 0, 0}, milliseconds(20)));
  EXPECT_NEAR(dut_.pose().x, 0.5, 1e-3);
}

TEST_F(OdometryTest, DoubleAndLateSamplesChangeNothing) {
  Wheels wheels;
  Add(wheels.Sample());
  const WheelSample early = wheels.Roll({0.5, 0, 0}, milliseconds(20));
  const WheelSample newest = wheels.Roll({0.5, 0, 0}, milliseconds(20));
  Add(newest);
  const double x = dut_.pose().x;
  EXPECT_FALSE(Add(newest));
  EXPECT_FALSE(Add(early));
  EXPECT_EQ(dut_.pose().x, x);
  EXPECT_EQ(dut_.counters().doubles, 1);
  EXPECT_EQ(dut_.counters().late, 1);
}

TEST_F(OdometryTest, OneAbsurdSampleIsRefusedAndTheNextCoversTheGap) {
  Wheels wheels;
  Add(wheels.Sample());
  WheelSample absurd = wheels.Roll({0.5, 0, 0}, milliseconds(20));
  absurd.ticks[2] += 1'000'000;
  EXPECT_FALSE(Add(absurd));
  Add(wheels.Roll({0.5, 0, 0}, milliseconds(20)));
  EXPECT_NEAR(dut_.pose().x, 0.02, 1e-3);
  EXPECT_EQ(dut_.counters().jumps, 1);
  EXPECT_EQ(dut_.counters().restarts, 0);
}

TEST_F(OdometryTest, ARestartedDriveBoardIsBelievedAtTheSecondSampleWithUnknownMotionBetween) {
  Wheels wheels(1'000'000);
  Add(wheels.Sample());
  Drive(wheels, {0.5, 0, 0}, 50);
  const double x = dut_.pose().x;
  WheelSample restarted{.time = *dut_.time() + milliseconds(100)};
  EXPECT_FALSE(Add(restarted));
  restarted.time += milliseconds(20);
  const auto step = Add(restarted);
  ASSERT_TRUE(step);
  EXPECT_FALSE(step->known);
  EXPECT_NEAR(std::sqrt(step->noise(0, 0)), 0.5 * 0.12, 1e-9);
  EXPECT_EQ(dut_.pose().x, x);
  EXPECT_EQ(dut_.counters().restarts, 1);
}

TEST_F(OdometryTest, ASampleFromTheFutureCannotBlockTheOnesThatFollow) {
  Wheels wheels;
  Add(wheels.Sample());
  WheelSample future = wheels.Sample();
  future.time += std::chrono::hours(1);
  EXPECT_FALSE(dut_.Add(future, kStart));
  EXPECT_EQ(dut_.counters().from_future, 1);
  EXPECT_TRUE(Add(wheels.Roll({0.5, 0, 0}, milliseconds(20))));
}

TEST_F(OdometryTest, AClockThatSteppedBackIsAcceptedAfterAWhile) {
  Wheels wheels;
  Add(wheels.Sample());
  Drive(wheels, {0.5, 0, 0}, 50);
  Wheels again;
  std::optional<OdometryStep> step;
  for (int i = 0; i < 25; ++i) step = Add(again.Roll({0, 0, 0}, milliseconds(20)));
  ASSERT_TRUE(step);
  EXPECT_FALSE(step->known);
  EXPECT_EQ(dut_.time(), kStart + milliseconds(500));
}

TEST_F(OdometryTest, StandingStillAddsNoUncertainty) {
  Wheels wheels;
  Add(wheels.Sample());
  EXPECT_TRUE(Add(wheels.Roll({}, milliseconds(20)))->noise.isZero());
}

TEST_F(OdometryTest, VarianceGrowsWithTheWayHoweverItIsCut) {
  const auto variance = [](milliseconds step, int count) {
    Odometry dut{OdometryConfig{}, kGeometry};
    Wheels wheels;
    dut.Add(wheels.Sample(), kStart);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int i = 0; i < count; ++i) {
      const WheelSample sample = wheels.Roll({0.4, 0.2, 0.3}, step);
      sum += dut.Add(sample, sample.time)->noise;
    }
    return sum;
  };
  const Eigen::Matrix3d fine = variance(milliseconds(20), 100), coarse = variance(milliseconds(100), 20);
  EXPECT_NEAR(fine(0, 0) / coarse(0, 0), 1, 0.02);
  EXPECT_NEAR(fine(2, 2) / coarse(2, 2), 1, 0.02);
}

/// Over many lengths of slip the errors walk as the random walks do that the configuration names.
TEST_F(OdometryTest, SlipOfDrivingForwardKeepsItsSignForAWhile) {
  const OdometryNoise noise;
  Wheels wheels;
  Add(wheels.Sample());
  const OdometryStep step = *Add(wheels.Roll({0.5, 0, 0}, milliseconds(20)));
  EXPECT_TRUE(step.noise.isZero(1e-12));
  EXPECT_NEAR(step.wander.kept, std::exp(-0.01 / noise.slip_length_m), 1e-4);
  double error = 0, yaw = 0, forgotten = 0, cross = 0;
  for (int i = 0; i < 3000; ++i) {
    yaw += 2 * 0.01 * cross + 0.01 * 0.01 * error;
    cross = step.wander.kept * (cross + 0.01 * error);
    forgotten = step.wander.kept * step.wander.kept * error;
    error = forgotten + step.wander.variance.y();
  }
  EXPECT_NEAR(std::sqrt(yaw), noise.yaw_rad_per_sqrt_m * std::sqrt(30), 0.02 * std::sqrt(yaw));
  const OdometryWander half = step.wander.Part(0.5);
  EXPECT_NEAR(half.kept * half.kept, step.wander.kept, 1e-9);
}

TEST_F(OdometryTest, ATurnOnTheSpotMovesTheBaseByChanceInXAndYAlike) {
  Wheels wheels;
  Add(wheels.Sample());
  const Eigen::Matrix3d noise = Add(wheels.Roll({0, 0, 1}, milliseconds(500)))->noise;
  EXPECT_NEAR(std::sqrt(noise(0, 0)), OdometryNoise().drift_m_per_sqrt_m * std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(std::sqrt(noise(1, 1)), OdometryNoise().drift_m_per_sqrt_m * std::sqrt(0.5), 1e-5);
}

TEST_F(OdometryTest, WheelsThatSlipAgainstEachOtherRaiseTheUncertainty) {
  Wheels straight, slipping;
  Odometry other{OdometryConfig{}, kGeometry};
  Add(straight.Sample());
  other.Add(slipping.Sample(), kStart);
  const WheelSample rolled = straight.Roll({0.5, 0, 0}, milliseconds(20));
  WheelSample spun = rolled;
  spun.ticks[0] += 60;
  const auto calm = Add(rolled), loose = other.Add(spun, spun.time);
  EXPECT_GT(loose->slip_m_s, 0.1);
  EXPECT_GT(loose->noise(1, 1), 10 * calm->noise(1, 1));
  EXPECT_GT(loose->noise(2, 2), 10 * calm->noise(2, 2));
}

}  // namespace
}  // namespace priamos::robot
