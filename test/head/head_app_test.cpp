#include "head/head_app.hpp"

#include <gmock/gmock.h>

#include "common/geometry.hpp"
#include "test/head/head_on_a_bench.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Bench = HeadOnABench<HeadApp>;

constexpr int kLeftAndRight = 3, kAllThree = 7;  // bits of a trigger

HeadSetting SettingOf(const head_command_t& m) {
  return {m.pan_rad,
          m.tilt_rad,
          {m.vergence_rad[0], m.vergence_rad[1]},
          {m.zoom_step[0], m.zoom_step[1]},
          {m.focus_step[0], m.focus_step[1]}};
}

TEST(HeadApp, UnaskedItMovesNothing) {
  Bench head;
  head.Run(2);
  EXPECT_TRUE(head.commands.empty());
  EXPECT_TRUE(head.triggers.empty());
  EXPECT_TRUE(head.fixes.Drain().empty());
}

TEST(HeadApp, ALookComesFromBelowAndExposesBothCamerasOnce) {
  Bench head;
  head.SendLook(7, 3);
  head.Run(1);
  const HeadConfig config;
  ASSERT_EQ(head.commands.size(), 2u);
  EXPECT_LT(head.commands[0].pan_rad, -0.5 * config.motors.approach_rad);
  EXPECT_LT(head.commands[0].zoom_step[1], config.zoom_step);
  EXPECT_TRUE(IsSameSetting(SettingOf(head.commands[1]), config.LookSetting(), 1e-9)) << "straight ahead";
  ASSERT_EQ(head.triggers.size(), 1u);
  EXPECT_EQ(head.triggers[0].cameras, kLeftAndRight);
}

TEST(HeadApp, TheThirdCameraTakesPartOnlyWhereItIsCalibratedAndWanted) {
  HeadConfig config;
  config.vision.third_camera = true;
  Bench wanted(config);
  wanted.SendLook(7, 3);
  wanted.Run(1);
  ASSERT_EQ(wanted.triggers.size(), 1u);
  EXPECT_EQ(wanted.triggers[0].cameras, kAllThree);
  HeadModel table = Bench::NearlyDrawn();
  table.lenses[kThird] = {};
  Bench uncalibrated(config, table);
  uncalibrated.SendLook(7, 3);
  uncalibrated.Run(1);
  ASSERT_EQ(uncalibrated.triggers.size(), 1u);
  EXPECT_EQ(uncalibrated.triggers[0].cameras, kLeftAndRight);
}

TEST(HeadApp, ALandmarkThatNobodyHasSentIsAnsweredSo) {
  Bench head;
  head.SendLook(7, 3);
  head.Run(1);
  const auto fixes = head.fixes.Drain();
  ASSERT_EQ(fixes.size(), 1u);
  EXPECT_EQ(fixes[0].request_id, 7);
  EXPECT_EQ(fixes[0].landmark_id, 3);
  EXPECT_EQ(fixes[0].verdict, landmark_fix_t::NO_MODEL);
  EXPECT_EQ(head.views.Drain().size(), 1u) << "a view comes with every fix";
  EXPECT_TRUE(head.Logged("look 7: landmark 3 not found: ")) << head.log.size();
}

TEST(HeadApp, WithoutAPoseOrAPictureTheVerdictSaysSo) {
  Bench head;
  head.SendBoard(3, 2.5, 0);
  head.SendLook(8, 3);
  head.Run(1);
  auto fixes = head.fixes.Drain();
  ASSERT_EQ(fixes.size(), 1u);
  EXPECT_EQ(fixes[0].verdict, landmark_fix_t::NO_POSE);
  EXPECT_EQ(fixes[0].model_x_m, 2.5);
  head.position_known = true;
  head.SendLook(9, 3);
  head.Run(1);
  fixes = head.fixes.Drain();
  ASSERT_EQ(fixes.size(), 1u);
  EXPECT_EQ(fixes[0].verdict, landmark_fix_t::NO_IMAGE) << "all black";
}

TEST(HeadApp, TheHeadTurnsToWhereTheLandmarkIsExpected) {
  for (const double side : {-1.0, 1.0}) {
    Bench head;
    head.position_known = true;
    head.SendBoard(3, 2.5, 2 * side);
    head.Run(0.1);
    head.SendLook(8, 3);
    head.Run(1);
    ASSERT_FALSE(head.commands.empty());
    // The angle at the pan axis, which stands before the robot's centre.
    const double expected = std::atan2(2 * side, 2.5 - HeadGeometry().x_m);
    EXPECT_NEAR(head.commands.back().pan_rad, expected, 0.25) << side;
  }
}

TEST(HeadApp, PicturesThatDoNotComeAreAskedForAgainAndThenGivenUp) {
  Bench head;
  head.cameras_answer = false;
  head.SendLook(7, 3);
  head.Run(4);
  EXPECT_EQ(head.triggers.size(), static_cast<std::size_t>(LookConfig().attempts));
  const auto fixes = head.fixes.Drain();
  ASSERT_EQ(fixes.size(), 1u);
  EXPECT_EQ(fixes[0].verdict, landmark_fix_t::NO_IMAGE);
  EXPECT_TRUE(head.Logged("no stereo pair arrived from the cameras"));
}

TEST(HeadApp, MotorsThatDoNotObeyEndTheLook) {
  for (const bool report : {true, false}) {
    Bench head;
    head.motors_obey = false;
    head.motors_report = report;
    head.SendLook(7, 3);
    head.Run(PositionerConfig().timeout_s - 0.5);
    EXPECT_TRUE(head.fixes.Drain().empty());
    head.Run(1);
    ASSERT_EQ(head.fixes.Drain().size(), 1u) << report;
    EXPECT_TRUE(head.triggers.empty());
    EXPECT_TRUE(head.Logged("the head did not reach its setting"));
  }
}

TEST(HeadApp, OrdersAreAnsweredOneAfterTheOther) {
  Bench head;
  for (const int id : {5, 9, 2}) head.SendLook(id, 3);
  head.Run(2);
  std::vector<int> answered;
  for (const auto& fix : head.fixes.Drain()) answered.push_back(fix.request_id);
  EXPECT_THAT(answered, testing::ElementsAre(5, 9, 2));
  EXPECT_EQ(head.triggers.size(), 3u);
  EXPECT_EQ(head.commands.size(), 2u) << "it stands there already";
}

TEST(HeadApp, OfTooManyOrdersTheOldestIsRefusedAtOnce) {
  Bench head;
  head.cameras_answer = false;
  for (int id = 1; id <= 17; ++id) head.SendLook(id, 3);
  head.Step();
  const auto fixes = head.fixes.Drain();
  ASSERT_EQ(fixes.size(), 1u);
  EXPECT_EQ(fixes[0].request_id, 1);
  EXPECT_EQ(fixes[0].verdict, landmark_fix_t::NO_IMAGE);
  EXPECT_TRUE(head.Logged("too many look requests at once: the oldest is refused"));
}

TEST(HeadApp, AnOperatorsHandMovesTheHead) {
  Bench head;
  head.Run(0.1);
  for (int i = 0; i < 10; ++i) {
    head.SendHand(0.5);
    head.Run(0.1);
  }
  ASSERT_FALSE(head.commands.empty());
  EXPECT_NEAR(head.counters.pan_rad, 0.5, 0.1);  // half a radian per second for a second
}

TEST(HeadApp, ALookGoesBeforeAnOperatorsHand) {
  Bench head;
  head.cameras_answer = false;
  head.Run(0.1);
  head.SendLook(7, 3);
  for (int i = 0; i < 10; ++i) {
    head.SendHand(0.5);
    head.Run(0.1);
  }
  EXPECT_EQ(head.commands.size(), 2u) << "only those of the look";
  EXPECT_EQ(head.counters.pan_rad, 0);
}

TEST(HeadApp, ItsPeriodIsThatOfItsConfiguration) {
  HeadConfig config;
  config.rate_hz = 100;
  EXPECT_EQ(Bench(config).dut->TickPeriod(), std::chrono::milliseconds(10));
}

TEST(HeadApp, WithoutATableItSaysHowToMakeOne) {
  HeadConfig config;
  config.calibration = "/none/kastor.yaml";
  EXPECT_THAT(support::ThrownReason([&] { Bench(config, Bench::Bare{}); }),
              AllOf(HasSubstr("/none/kastor.yaml"), HasSubstr("--calibrate")));
}

TEST(HeadApp, ATableThatDoesNotCoverItsLooksIsRefused) {
  HeadModel table = Bench::NearlyDrawn();
  table.lenses[kRight] = LensTable();
  EXPECT_THAT(support::ThrownReason([&] { Bench({}, table); }),
              AllOf(HasSubstr("kastor.yaml: right camera: "),
                    HasSubstr("calibrate it with `priamos-head --calibrate`")));
  HeadConfig config;
  config.zoom_step += 100;
  EXPECT_THAT(support::ThrownReason([&] { Bench{config}; }), HasSubstr("kastor.yaml: left camera: "));
}

}  // namespace
}  // namespace priamos::head
