#include "robot/robot_messages.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <set>

#include "common/covariance.hpp"

namespace priamos::robot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const Time kNow = FromUtime(1'234'567);

path_t SomePath() {
  path_t message{};
  message.path_id = 7;
  message.estop_changes = 201;
  message.speed_m_s = 0.3;
  message.points.resize(2);
  message.points[0].x_m = 1;
  message.points[1] = message.points[0];
  message.points[1].yaw_rad = 0.5;
  message.n_points = 2;
  return message;
}

landmark_fix_t SomeFix() {
  landmark_fix_t message{};
  message.utime_exposure = 1'000'000;
  message.request_id = 5;
  message.verdict = landmark_fix_t::FOUND;
  message.x_m = 2.4;
  message.y_m = 0.1;
  message.yaw_rad = -0.05;
  message.sigma_x_m = 0.02;
  message.sigma_y_m = 0.01;
  message.sigma_yaw_rad = 0.005;
  message.rho_y_yaw = -0.5;
  message.own_share = 0.25F;
  message.model_x_m = 6;
  message.model_y_m = 2.4;
  return message;
}

TEST(WheelMessages, StateKeepsOrderAndTime) {
  wheel_state_t message{};
  message.utime = 42;
  for (int i = 0; i < 4; ++i) message.position_ticks[i] = 10 * i - 5;
  message.deadline_stopped = 1;
  const WheelSample dut = FromMessage(message);
  EXPECT_EQ(ToUtime(dut.time), 42);
  EXPECT_THAT(dut.ticks, testing::ElementsAre(-5, 5, 15, 25));
  EXPECT_TRUE(dut.deadline_stopped);
}

TEST(WheelMessages, CommandKeepsOrderAndTime) {
  const wheel_command_t message = ToMessage(WheelSpeeds{1, 2, 3, 4}, 77, kNow);
  EXPECT_EQ(message.instance, 77);
  EXPECT_EQ(message.utime, ToUtime(kNow));
  EXPECT_THAT(message.speed_rad_s, testing::ElementsAre(1, 2, 3, 4));
}

TEST(SonarMessages, KeepNumberingAndMissingEchoes) {
  sonar_ranges_t message{};
  for (int i = 0; i < 24; ++i) message.range_m[i] = 0.1 * i;
  message.range_m[3] = -1;
  const SonarCycle dut = FromMessage(message);
  EXPECT_DOUBLE_EQ(dut.range_m[23], 2.3);
  EXPECT_EQ(dut.range_m[3], -1);
}

TEST(PathMessages, PointsAndSpeedAreKept) {
  const auto dut = FromMessage(SomePath());
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->id, 7);
  EXPECT_EQ(dut->estop_changes, 201);
  ASSERT_EQ(dut->points.size(), 2u);
  EXPECT_EQ(dut->points[1].yaw, 0.5);
}

TEST(PathMessages, LeewayBelongsToTheLineToItsPoint) {
  path_t message = SomePath();
  message.points[0].left_m = 1.2;
  message.points[1].right_m = 0.4;
  const auto dut = FromMessage(message);
  ASSERT_TRUE(dut);
  ASSERT_EQ(dut->leeway.size(), 2u);
  EXPECT_EQ(dut->leeway[0].left_m, 1.2);
  EXPECT_EQ(dut->leeway[0].right_m, 0);
  EXPECT_EQ(dut->leeway[1].right_m, 0.4);
}

TEST(PathMessages, NoPointsIsAnOrderToHoldWhateverTheSpeed) {
  path_t message{};
  message.path_id = 8;
  const auto dut = FromMessage(message);
  ASSERT_TRUE(dut);
  EXPECT_TRUE(dut->points.empty());
}

TEST(PathMessages, WhatCannotBeDrivenIsRefused) {
  path_t slow = SomePath(), infinite = SomePath(), outside = SomePath(), odd = SomePath();
  path_t vague = SomePath(), inside_out = SomePath();
  slow.speed_m_s = 0;
  infinite.points[0].x_m = kNaN;
  outside.points[1].y_m = 1e6;
  odd.speed_m_s = kNaN;
  vague.points[0].left_m = kNaN;
  inside_out.points[1].right_m = -1;
  for (const path_t& message : {slow, infinite, outside, odd, vague, inside_out})
    EXPECT_FALSE(FromMessage(message));
}

TEST(FixMessages, FoundGivesSightModelAndCovariance) {
  const auto dut = FromMessage(SomeFix());
  ASSERT_TRUE(dut);
  EXPECT_EQ(ToUtime(dut->exposure), 1'000'000);
  EXPECT_EQ(dut->request_id, 5);
  EXPECT_EQ(dut->base_from_landmark.x, 2.4);
  EXPECT_EQ(dut->map_from_landmark.y, 2.4);
  EXPECT_NEAR(dut->covariance(1, 2), -0.5 * 0.01 * 0.005, 1e-12);
  EXPECT_EQ(dut->own_share, 0.25);
}

TEST(FixMessages, NotFoundGivesNoFixButAnAnswer) {
  landmark_fix_t message = SomeFix();
  message.verdict = landmark_fix_t::AMBIGUOUS;
  EXPECT_FALSE(FromMessage(message));
  const pose_correction_t answer = NotFound(message, kNow);
  EXPECT_EQ(answer.verdict, pose_correction_t::NOT_FOUND);
  EXPECT_EQ(answer.request_id, 5);
  EXPECT_EQ(answer.utime_exposure, 1'000'000);
}

TEST(FixMessages, NumbersThatMakeNoSenseBecomeAFixThatIsRefused) {
  landmark_fix_t negative = SomeFix(), odd = SomeFix(), correlated = SomeFix(), shared = SomeFix();
  negative.sigma_x_m = -1;
  odd.sigma_yaw_rad = kNaN;
  correlated.rho_x_y = 3;
  shared.own_share = 2;
  Localiser localiser{LocaliserConfig{}, MecanumGeometry{}, Footprint{}};
  for (int i = 0; i < 5; ++i) {
    const Time time = FromUtime(980'000 + i * 20'000);
    localiser.AddWheels({.time = time}, time);
  }
  for (const landmark_fix_t& message : {negative, odd, correlated, shared}) {
    localiser.AddFix(*FromMessage(message), kNow);
    EXPECT_EQ(localiser.Step(kNow).at(0).result.verdict, FixVerdict::kImplausible);
  }
}

scene_object_t SomeThing() {
  scene_object_t message{};
  message.utime_seen = 1'000'000;
  message.id = 7;
  message.kind = scene_object_t::BOX;
  message.x_m = 3;
  message.y_m = -1;
  message.yaw_rad = 0.5;
  message.width_m = 1.2;
  message.depth_m = 0.6;
  message.bottom_m = 0.66;
  message.top_m = 0.72;
  message.sigma_along_m = 0.03;
  message.sigma_across_m = 0.01;
  message.looks = 2;
  return message;
}

TEST(SceneObjectMessage, AThingKeepsItsNumbers) {
  const auto dut = FromMessage(SomeThing());
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->id, 7);
  EXPECT_EQ(ToUtime(dut->seen), 1'000'000);
  EXPECT_EQ(dut->map_from_front.x, 3);
  EXPECT_EQ(dut->width_m, 1.2);
  EXPECT_EQ(dut->depth_m, 0.6);
  EXPECT_EQ(dut->top_m, 0.72);
  EXPECT_EQ(dut->sigma_m, 0.03);
  EXPECT_FALSE(dut->has_gone || dut->is_edge);
  scene_object_t gone = SomeThing();
  gone.looks = 0;
  EXPECT_TRUE(FromMessage(gone)->has_gone);
}

TEST(SceneObjectMessage, NumbersOutOfRangeAreRefused) {
  const auto refused = [](auto change) {
    scene_object_t message = SomeThing();
    change(message);
    return !FromMessage(message);
  };
  EXPECT_TRUE(refused([](scene_object_t& m) { m.kind = 3; }));
  EXPECT_TRUE(refused([](scene_object_t& m) { m.x_m = kNaN; }));
  EXPECT_TRUE(refused([](scene_object_t& m) { m.width_m = 6; }));
  EXPECT_TRUE(refused([](scene_object_t& m) { m.depth_m = kNaN; }));
  EXPECT_TRUE(refused([](scene_object_t& m) { m.bottom_m = 0.8; })) << "it would end below where it begins";
  EXPECT_TRUE(refused([](scene_object_t& m) { m.sigma_along_m = -1; }));
  EXPECT_TRUE(refused([](scene_object_t& m) { m.looks = -1; }));
}

obstacle_line_t SomeLine() {
  obstacle_line_t message{};
  message.utime_exposure = 1'000'000;
  message.verdict = obstacle_line_t::OBSTACLE;
  for (const int kind : {obstacle_segment_t::UP, obstacle_segment_t::MISSING, obstacle_segment_t::DOWN}) {
    obstacle_segment_t s{};
    s.kind = static_cast<std::int8_t>(kind);
    s.x1_m = 2.0F;
    s.y1_m = -0.5F;
    s.x2_m = 2.25F;
    s.y2_m = 0.25F;
    s.height_m = kind == obstacle_segment_t::DOWN ? -0.125F : 0.03F;
    message.segments.push_back(s);
  }
  message.n_segments = 3;
  return message;
}

TEST(FloorMessages, StepsUpAndDownAreTakenAndWhatIsMissingIsNot) {
  const auto dut = FromMessage(SomeLine());
  ASSERT_TRUE(dut);
  ASSERT_EQ(dut->pieces.size(), 2u);
  EXPECT_EQ(dut->pieces[1].height_m, -0.125);
  EXPECT_EQ(dut->pieces[0].left.y(), 0.25);
}

TEST(FloorMessages, NumbersThatMakeNoSenseAreRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto refused = [](auto spoil) {
    obstacle_line_t message = SomeLine();
    spoil(message);
    return !FromMessage(message);
  };
  EXPECT_TRUE(refused([](auto& m) { m.verdict = 3; }));
  EXPECT_TRUE(refused([&](auto& m) { m.segments[0].x1_m = nan; }));
  EXPECT_TRUE(refused([&](auto& m) { m.segments[1].y2_m = nan; }));
  EXPECT_TRUE(refused([&](auto& m) { m.segments[0].height_m = nan; }));
  EXPECT_TRUE(refused([](auto& m) { m.segments[0].x2_m = -0.5F; }));
  EXPECT_TRUE(refused([](auto& m) { m.segments[2].y1_m = 1e30F; }));
  EXPECT_TRUE(refused([](auto& m) { m.segments[2].kind = 7; }));
  EXPECT_TRUE(refused([](auto& m) { m.segments[2].sigma_height_m = -1; }));
}

TEST(PoseMessages, CovarianceRoundTripsThroughSigmasAndCorrelations) {
  PoseEstimate estimate{.time = kNow, .pose = {1, 2, 0.3}, .twist = {0.4, 0.1, -0.2}};
  estimate.covariance << 4e-4, 1e-5, 2e-5, 1e-5, 1e-4, -3e-5, 2e-5, -3e-5, 9e-5;
  const pose_t message = ToMessage(estimate);
  EXPECT_EQ(message.utime, ToUtime(kNow));
  EXPECT_EQ(message.y_m, 2);
  EXPECT_EQ(message.wz_rad_s, -0.2);
  const Eigen::Matrix3d back = ToCovariance({message.sigma_x_m, message.sigma_y_m, message.sigma_yaw_rad,
                                             message.rho_x_y, message.rho_x_yaw, message.rho_y_yaw});
  EXPECT_LT((back - estimate.covariance).norm(), 1e-12);
}

TEST(StatusMessages, EveryModeHasItsOwnCode) {
  const auto code = [](DriveMode mode) {
    DriveState state;
    state.mode = mode;
    return ToMessage(state, 0, kNow).mode;
  };
  EXPECT_EQ(code(DriveMode::kIdle), drive_status_t::IDLE);
  EXPECT_EQ(code(DriveMode::kFollowing), drive_status_t::FOLLOWING);
  EXPECT_EQ(code(DriveMode::kArrived), drive_status_t::ARRIVED);
  EXPECT_EQ(code(DriveMode::kHolding), drive_status_t::HOLDING);
  EXPECT_EQ(code(DriveMode::kBlocked), drive_status_t::BLOCKED);
}

/// Of two touches the mode tells which.
TEST(StatusMessages, EveryConditionHasItsOwnLimitAndText) {
  std::set<int> codes;
  for (std::size_t i = 0; i < kConditions; ++i) {
    DriveState state;
    state.failsafe = {FailsafeAction::kHold, static_cast<Condition>(i)};
    codes.insert(ToMessage(state, 0, kNow).limit);
    EXPECT_FALSE(Text(static_cast<Condition>(i)).empty());
  }
  EXPECT_EQ(codes.size(), kConditions - 1);
  EXPECT_FALSE(codes.contains(drive_status_t::LIMIT_NONE));
  EXPECT_FALSE(codes.contains(drive_status_t::LIMIT_SONAR));
}

TEST(StatusMessages, EveryRefusalHasItsOwnCode) {
  std::set<int> codes;
  for (const auto verdict :
       {CommandVerdict::kAccepted, CommandVerdict::kWithoutLease, CommandVerdict::kOutOfOrder,
        CommandVerdict::kTooOld, CommandVerdict::kOutOfRange, CommandVerdict::kNotAtRest}) {
    DriveState state;
    state.refusal = verdict;
    codes.insert(ToMessage(state, 0, FromUtime(1)).refusal);
  }
  EXPECT_EQ(codes.size(), kCommandVerdicts);
}

TEST(CommandMessages, KeepSenderOrderLifeAndTwist) {
  drive_command_t message{};
  message.utime = 5'000'000;
  message.driver = lease_request_t::CONSOLE;
  message.session = 9;
  message.sequence = 77;
  message.time_to_live_s = 0.15;
  message.vx_m_s = 0.1;
  message.vy_m_s = -0.2;
  message.wz_rad_s = 0.3;
  const DriveCommand dut = FromMessage(message);
  EXPECT_EQ(dut.time, FromUtime(5'000'000));
  EXPECT_EQ(dut.from, (LeaseHolder{Driver::kConsole, 9}));
  EXPECT_EQ(dut.sequence, 77);
  EXPECT_EQ(dut.time_to_live, std::chrono::milliseconds(150));
  EXPECT_EQ(dut.twist.vx, 0.1);
  EXPECT_EQ(dut.twist.vy, -0.2);
  EXPECT_EQ(dut.twist.wz, 0.3);
}

TEST(CommandMessages, UnknownDriversAndAbsurdLivesCountAsNobodyAndNever) {
  drive_command_t message{};
  message.driver = 99;
  message.time_to_live_s = std::nan("");
  EXPECT_EQ(FromMessage(message).from.driver, Driver::kNobody);
  EXPECT_EQ(FromMessage(message).time_to_live, Duration::zero());
  message.time_to_live_s = 1e300;
  EXPECT_EQ(FromMessage(message).time_to_live, Duration::zero());
}

TEST(LeaseMessages, WhatDoesNotExistIsRefused) {
  lease_request_t message{};
  message.driver = lease_request_t::TELEOP;
  message.action = lease_request_t::TAKE_OVER;
  ASSERT_TRUE(FromMessage(message));
  EXPECT_EQ(FromMessage(message)->wish, Lease::Wish::kTakeOver);
  message.action = 3;
  EXPECT_FALSE(FromMessage(message));
  message.action = 0;
  message.driver = -1;
  EXPECT_FALSE(FromMessage(message));
}

TEST(StatusMessages, SonarIsTheLimitWhenNothingWorseIs) {
  DriveState state;
  state.slowed_by_sonar = true;
  state.nearest = {0.4, {0.7, -0.3}};
  const drive_status_t message = ToMessage(state, 0.2, kNow);
  EXPECT_EQ(message.limit, drive_status_t::LIMIT_SONAR);
  EXPECT_EQ(message.nearest_m, 0.4);
  EXPECT_EQ(message.nearest_x_m, 0.7);
  EXPECT_EQ(message.nearest_y_m, -0.3);
  EXPECT_EQ(ToMessage(DriveState{}, 0, kNow).nearest_m, -1);
}

TEST(CorrectionMessages, SayWhatWasChangedAndHowSureItIs) {
  Localiser::Answer answer;
  answer.fix.exposure = FromUtime(99);
  answer.fix.request_id = 3;
  answer.result.verdict = FixVerdict::kApplied;
  answer.result.change = {0.1, -0.2, 0.03};
  answer.result.distance = 1.5;
  answer.result.at_picture.covariance = Eigen::Vector3d(1e-4, 4e-4, 1e-6).asDiagonal();
  const pose_correction_t message = ToMessage(answer, kNow);
  EXPECT_EQ(message.verdict, pose_correction_t::APPLIED);
  EXPECT_EQ(message.utime_exposure, 99);
  EXPECT_EQ(message.dy_m, -0.2);
  EXPECT_NEAR(message.sigma_m, 0.02, 1e-9);
  EXPECT_NEAR(message.sigma_yaw_rad, 1e-3, 1e-9);
}

}  // namespace
}  // namespace priamos::robot
