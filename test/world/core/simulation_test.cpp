#include "world/core/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "world/core/scene/build_solids.hpp"

namespace priamos::world {
namespace {

constexpr Duration kTick{10000};

/// A simulation in a hall with one wall 5 m ahead, commanded every 20 ms.
class SimulationTest : public ::testing::Test {
 protected:
  SimulationTest() {
    model_.base.radius_error = model_.base.lever_error = model_.base.lateral_loss = model_.base.roller_slip =
        0;
    model_.base.acceleration_slip_s2_m = 0;
    solids_.push_back({"wall", {5.1, 0, 0}, {0.2, 20}, 0, 2.8, "plaster"});
  }

  Simulation& Start(const Pose2& start = {}) {
    cameras_ = std::make_unique<CameraServer>(model_.camera, 0, executor_, 1);
    dut_ = std::make_unique<Simulation>(model_, WithPeople(solids_, hazards_.people), start, *cameras_, 1,
                                        hazards_);
    dut_->Advance(now_);
    dut_->TakeTruth();
    return *dut_;
  }
  /// Runs and returns the last truth.
  Truth Run(double seconds, const PerWheel* wheels = nullptr) {
    std::optional<Truth> last;
    for (int i = 0; i < seconds / Seconds(kTick); ++i) {
      if (wheels && i % 2 == 0) dut_->CommandWheels(now_, 1, *wheels);
      now_ += kTick;
      EXPECT_EQ(dut_->Advance(now_), Duration(0));
      if (auto truth = dut_->TakeTruth()) last = truth;
    }
    return last.value();
  }

  RobotModel model_;
  Hazards hazards_;
  std::vector<Solid> solids_;
  std::vector<RenderJob> jobs_;
  InlineRenderExecutor executor_{[this](const RenderJob& job) {
    jobs_.push_back(job);
    return GreyImage{1, 1, {0}};
  }};
  std::unique_ptr<CameraServer> cameras_;
  std::unique_ptr<Simulation> dut_;
  Time now_ = FromUtime(1'000'000);
  const PerWheel forward_{5, 5, 5, 5};
};

TEST_F(SimulationTest, ABaseThatDrivesAgainstAWallPressesItsBumperAndItsMotorsPush) {
  model_.motors.noise_a = model_.motors.offset_a = model_.motors.mass_error = 0;
  Start();
  Run(3, &forward_);
  auto touch = dut_->TakeTouch();
  ASSERT_TRUE(touch);
  EXPECT_EQ(touch->pressed, 0);
  EXPECT_LT(touch->current_a[0], 0.5);
  Run(8, &forward_);
  touch = dut_->TakeTouch();
  EXPECT_EQ(touch->pressed, 0xC3) << "the front, and the sides at its corners";
  EXPECT_NEAR(touch->current_a[0], 0.615 * 180 * 9.81 / 4 / 20, 0.1);
}

TEST_F(SimulationTest, DrivesAsCommanded) {
  Start();
  const Truth truth = Run(3, &forward_);
  EXPECT_NEAR(truth.velocity.vx, 0.5, 0.001);
  // Ramp and lag cost 0.5/1.5/2 + 0.04 s of full speed.
  EXPECT_NEAR(truth.map_from_base.x, 0.5 * (3 - 1.0 / 6 - 0.04), 0.01);
  EXPECT_NEAR(truth.map_from_base.y, 0, 1e-9);
}

TEST_F(SimulationTest, StopsWhenCommandsCease) {
  Start();
  const double moving = Run(2, &forward_).map_from_base.x;
  const Truth truth = Run(1.5);
  EXPECT_EQ(truth.velocity.vx, 0);
  // 0.2 s at full speed, then braking at 3 m/s^2 with the lag of the wheels; the last command is 20 ms old.
  EXPECT_LT(truth.map_from_base.x - moving, 0.5 * 0.2 + 0.5 * 0.5 / 2 / 3 + 0.5 * 0.05);
  EXPECT_GT(truth.map_from_base.x - moving, 0.5 * 0.17);
  EXPECT_TRUE(dut_->TakeWheels()->reading.deadline_stopped);
}

TEST_F(SimulationTest, ObstaclesStopTheBaseAndCountOnce) {
  Start();
  const Truth truth = Run(15, &forward_);
  EXPECT_NEAR(truth.map_from_base.x, 5 - 0.475, 0.001);
  EXPECT_NEAR(truth.velocity.vx, 0, 1e-4);
  EXPECT_EQ(truth.contacts, 1);
  EXPECT_LT(truth.min_gap_m, 0.0005);
  // The wheels go on turning: odometry believes in a way that was not made.
  EXPECT_GT(dut_->TakeWheels()->reading.position_ticks[0] / 4096.0 * 2 * kPi * 0.1, 7);
}

TEST_F(SimulationTest, ABlockedBaseCanBackOff) {
  Start();
  Run(12, &forward_);
  const PerWheel backward{-5, -5, -5, -5};
  const Truth truth = Run(3, &backward);
  EXPECT_LT(truth.map_from_base.x, 3.6);
  EXPECT_GT(truth.gap_m, 0.8);
  EXPECT_EQ(truth.contacts, 1);
}

TEST_F(SimulationTest, GapAndItsMinimumAreTruth) {
  Start();
  EXPECT_NEAR(Run(0.1).gap_m, 5 - 0.475, 1e-9);
  Run(4, &forward_);
  const PerWheel backward{-5, -5, -5, -5};
  const Truth truth = Run(3, &backward);
  EXPECT_LT(truth.min_gap_m, truth.gap_m - 0.5);
  EXPECT_EQ(truth.contacts, 0);
}

TEST_F(SimulationTest, TheGapIsExactAllAlongACurvedDrive) {
  model_ = RobotModel{};
  solids_.push_back({"post", {2.0, 1.0, 0.4}, {0.1, 0.1}, 0, 2, "metal"});
  solids_.push_back({"carton", {1.0, -1.2, 0.9}, {0.6, 0.3}, 0, 0.5, "cardboard"});
  Start();
  const Clearance exact(BodyOf(model_), solids_);
  const PerWheel curve{2, 6, 3, 5};
  double least = 10;
  for (int i = 0; i < 150; ++i) {
    const Truth truth = Run(0.04, &curve);
    EXPECT_NEAR(truth.gap_m, exact.Gap(truth.map_from_base, 10), 1e-12);
    least = std::min(least, truth.gap_m);
    EXPECT_LE(truth.min_gap_m, least);
  }
}

TEST_F(SimulationTest, EncodersAgreeWithTheWayWithoutSlip) {
  Start();
  const Truth truth = Run(4, &forward_);
  const auto wheels = dut_->TakeWheels();
  EXPECT_NEAR(wheels->reading.position_ticks[1] / 4096.0 * 2 * kPi * 0.1, truth.map_from_base.x, 0.002);
  EXPECT_EQ(wheels->time, truth.time);
}

TEST_F(SimulationTest, SamplesComeAtTheirRatesWithTheirTimes) {
  Start();
  int wheels = 0, sonars = 0, heads = 0, truths = 0;
  for (int i = 0; i < 100; ++i) {
    now_ += kTick;
    dut_->Advance(now_);
    wheels += dut_->TakeWheels().has_value();
    sonars += dut_->TakeSonars().has_value();
    heads += dut_->TakeHead().has_value();
    if (const auto truth = dut_->TakeTruth()) {
      ++truths;
      EXPECT_EQ((truth->time - FromUtime(1'000'000)) % Duration(20000), Duration(0));
    }
  }
  EXPECT_EQ(wheels, 51);  // the first sample was taken at the start
  EXPECT_EQ(heads, 51);
  EXPECT_EQ(truths, 50);  // Start() took the first one
  EXPECT_EQ(sonars, 10);
}

TEST_F(SimulationTest, SonarsSeeTheWallFromWhereTheBaseTrulyIs) {
  Start();
  Run(4, &forward_);
  std::optional<SonarSample> sample;
  for (int i = 0; i < 20 || !sample; ++i) {
    Run(0.02, &forward_);
    if (auto newer = dut_->TakeSonars()) sample = newer;
  }
  const Truth truth = Run(0.02, &forward_);
  EXPECT_NEAR(sample->ranges_m[0], 5 - 0.475 - truth.map_from_base.x, 0.15);
}

TEST_F(SimulationTest, AnExposureSpansTheMotionDuringIt) {
  Start();
  Run(2, &forward_);
  dut_->CommandHead({0.2, 0, {0, 0}, {650, 650}, {1600, 1600}});
  ASSERT_TRUE(dut_->Trigger(now_, 3, 3));
  Run(0.06, &forward_);
  ASSERT_EQ(jobs_.size(), 2u);
  const auto& job = jobs_[0];
  EXPECT_NEAR(job.closing.map_from_base.x - job.opening.map_from_base.x, 0.5 * 0.008, 1e-5);
  EXPECT_GE(job.closing.head.pan_rad, job.opening.head.pan_rad);
  const auto frame = cameras_->Collect(now_);
  ASSERT_TRUE(frame);
  // The time stamp is the middle of the exposure: where the base was then lies between the two viewpoints.
  EXPECT_EQ(frame->exposure_middle, now_ - Duration(60000) + Duration(8000));
}

TEST_F(SimulationTest, AShutterBetweenStepsSeesThePoseBetweenSteps) {
  model_.camera.trigger_delay_s = 0.0041;
  Start();
  const Truth before = Run(2, &forward_);
  ASSERT_EQ(before.time, now_);
  dut_->Trigger(now_, 3, 1);
  Run(0.04, &forward_);
  ASSERT_EQ(jobs_.size(), 1u);
  EXPECT_NEAR(jobs_[0].opening.map_from_base.x, before.map_from_base.x + 0.5 * 0.0041, 1e-5);
}

TEST_F(SimulationTest, ALongSilenceOfTheCallerIsSkippedNotSimulated) {
  Start();
  Run(2, &forward_);
  now_ += Duration(10'000'000);
  EXPECT_GT(dut_->Advance(now_), Duration(9'000'000));
  const auto truth = dut_->TakeTruth();
  EXPECT_NEAR(Seconds(now_ - truth->time), 0, 0.02);
  EXPECT_LT(truth->map_from_base.x, 1.2);
  EXPECT_EQ(truth->velocity.vx, 0);  // the drive board's dead-line passed long ago
}

TEST_F(SimulationTest, StartingInsideASolidIsRefused) {
  EXPECT_THROW(Start({4.8, 0, 0}), std::invalid_argument);
}

TEST_F(SimulationTest, TheSameSeedAndCommandsGiveTheSameWorld) {
  model_ = RobotModel{};
  const auto run = [this] {
    now_ = FromUtime(1'000'000);
    Start();
    const Truth truth = Run(3, &forward_);
    const auto sonars = dut_->TakeSonars();
    return std::tuple(truth.map_from_base.x, truth.map_from_base.y, truth.map_from_base.yaw, sonars->ranges_m,
                      dut_->TakeWheels()->reading.position_ticks);
  };
  EXPECT_EQ(run(), run());
}

PersonPlan Standing(double x_m, double y_m) {
  PersonPlan plan;
  plan.name = "visitor";
  plan.waypoints = {{x_m, y_m, 0, 0}};
  return plan;
}

TEST_F(SimulationTest, APersonDrivenAgainstIsHeardFeltAndCounted) {
  hazards_.people = {Standing(3, 0)};
  Start();
  const double at = Run(1, &forward_).map_from_base.x;
  EXPECT_NEAR(dut_->TakeSonars()->ranges_m[0], 3 - 0.065 - 0.475 - at, 0.08) << "its legs";
  const Truth truth = Run(6, &forward_);
  EXPECT_EQ(truth.contacts, 1);
  EXPECT_LT(truth.min_gap_m, 0.0005);
  EXPECT_NEAR(truth.map_from_base.x, 3 - 0.475 - 0.12, 0.02) << "the trunk stops it";
  const auto touches = dut_->TakeTouchEvents();
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_EQ(touches[0].kind, TouchEvent::Kind::kDriven);
  EXPECT_EQ(touches[0].thing, "visitor: trunk");
  EXPECT_NEAR(touches[0].in_base.x(), 0.475, 1e-9);
}

TEST_F(SimulationTest, APersonWhoWalksIntoAStandingBaseIsCountedApart) {
  PersonPlan walker = Standing(3, 0);
  walker.attentive = false;
  walker.waypoints.push_back({-3, 0, 0, 0});
  hazards_.people = {walker};
  Start();
  const Truth truth = Run(5);
  EXPECT_EQ(truth.contacts, 0);
  EXPECT_GT(truth.min_gap_m, 1) << "nothing that the base did";
  const auto touches = dut_->TakeTouchEvents();
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_EQ(touches[0].kind, TouchEvent::Kind::kMovedIn);
}

TEST_F(SimulationTest, TheBumperFeelsAShoe) {
  PersonPlan walker = Standing(0, 3);
  walker.attentive = false;
  walker.waypoints.push_back({0, -3, 0, 0});
  hazards_.people = {walker};
  Start();
  std::uint8_t pressed = 0;
  for (int i = 0; i < 100; ++i) {
    Run(0.05);
    if (const auto touch = dut_->TakeTouch()) pressed |= touch->pressed;
  }
  EXPECT_NE(pressed & 0x06, 0) << "a shoe at the left side";
  EXPECT_EQ(pressed & ~0x06, 0);
}

TEST_F(SimulationTest, AWheelOverAHoleEndsTheDrive) {
  HolePlan step;
  step.name = "stairs";
  step.x_m = 2;
  hazards_.holes = {step};
  Start();
  const Truth truth = Run(8, &forward_);
  EXPECT_EQ(truth.contacts, 1);
  EXPECT_NEAR(truth.map_from_base.x, 1.5 - model_.base.half_wheelbase_m, 0.01);
  EXPECT_EQ(truth.velocity.vx, 0);
  const auto touches = dut_->TakeTouchEvents();
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_EQ(touches[0].kind, TouchEvent::Kind::kFell);
  EXPECT_EQ(touches[0].thing, "stairs");
  EXPECT_NE(dut_->TakeWheels()->reading.position_ticks[0], 0) << "the wheels turn on";
}

TEST_F(SimulationTest, StartingOverAHoleIsRefused) {
  HolePlan hole;
  hazards_.holes = {hole};
  EXPECT_THROW(Start(), std::invalid_argument);
}

TEST_F(SimulationTest, AStalledMotorStandsItsEncoderSaysSoAndTheBaseTurns) {
  hazards_.faults.motors = {{"front_left", "stalled", 1}};
  Start();
  Run(0.9, &forward_);
  const auto before = dut_->TakeWheels()->reading.position_ticks;
  Run(0.5, &forward_);
  dut_->TakeWheels();
  const auto stalled = (Run(0.1, &forward_), dut_->TakeWheels()->reading.position_ticks);
  const Truth truth = Run(1, &forward_);
  const auto after = dut_->TakeWheels()->reading.position_ticks;
  EXPECT_GT(stalled[0], before[0]);
  EXPECT_EQ(after[0], stalled[0]);
  EXPECT_GT(after[1], stalled[1] + 1000);
  EXPECT_GT(truth.map_from_base.yaw, 0.05) << "the left side stays behind";
}

TEST_F(SimulationTest, ALooseWheelsEncoderTurnsAndItsMotorTakesNoCurrent) {
  model_.motors.noise_a = model_.motors.offset_a = model_.motors.mass_error = 0;
  hazards_.faults.motors = {{"rear_right", "loose", 0.5}};
  Start();
  Run(0.4, &forward_);
  Run(2, &forward_);
  const auto touch = dut_->TakeTouch();
  EXPECT_NEAR(touch->current_a[3], 0, 1e-3);
  EXPECT_GT(touch->current_a[0], 0.05);
  const auto ticks = dut_->TakeWheels()->reading.position_ticks;
  EXPECT_NEAR(ticks[3], ticks[0], 50) << "the encoder is at the motor";
}

TEST_F(SimulationTest, ALeafThatSwingsAgainstTheBaseIsNotTheBasesDoing) {
  DoorPlan door;
  door.name = "lab";
  for (const Solid& solid : DoorSolids(door, DoorWork{}, 100)) solids_.push_back(solid);
  hazards_.leaves = {{door, "left", 0.04, LeafName(door), {{0.5, 0, 90}}}};
  Start({0.5, 0, 0});
  const Truth truth = Run(3);
  EXPECT_EQ(truth.contacts, 0);
  const auto touches = dut_->TakeTouchEvents();
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_EQ(touches[0].kind, TouchEvent::Kind::kMovedIn);
  EXPECT_EQ(touches[0].thing, "lab: leaf");
}

TEST_F(SimulationTest, CamerasSeeWhereAPersonIsAndHowTheMastLeans) {
  PersonPlan walker = Standing(3, -1);
  walker.waypoints.push_back({3, 5, 0, 0});
  hazards_.people = {walker};
  hazards_.mast.nod_deg_s2_m = 0.3;
  Start();
  Run(1);
  dut_->Trigger(now_, 1, 1);
  Run(0.1, &forward_);
  ASSERT_EQ(jobs_.size(), 1u);
  ASSERT_EQ(jobs_[0].closing.moved.size(), kBodyParts);
  EXPECT_NEAR(jobs_[0].closing.moved[2].map_from_solid.y, -1 + 0.8 * 1, 0.05);
  EXPECT_LT(jobs_[0].closing.head.lean.pitch_rad, 0) << "it accelerates: the head goes back";
}

}  // namespace
}  // namespace priamos::world
