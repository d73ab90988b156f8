#include "cli/scenario/stand_confirmation.hpp"

#include <gmock/gmock.h>

namespace priamos::cli {
namespace {

using testing::HasSubstr;

constexpr int kStand = 12;

path_t ToStand(int id = kStand) {
  path_t path{};
  path.path_id = id;
  return path;
}

drive_status_t Reports(std::int8_t mode, double speed_m_s, int path_id) {
  drive_status_t drive{};
  drive.mode = mode;
  drive.speed_m_s = speed_m_s;
  drive.path_id = path_id;
  return drive;
}

const Time kOrdered = FromUtime(5'000'000);
Time After(double seconds) {
  return kOrdered + FromSeconds(seconds);
}

TEST(StandConfirmation, TheRobotStandsWhenItReportsTheOrdersNumberAtRest) {
  StandConfirmation dut;
  dut.Hear(Reports(drive_status_t::FOLLOWING, 0.28, 11), After(-0.2));
  dut.Hear(ToStand());
  EXPECT_FALSE(dut.Stands(kOrdered, After(0)));
  dut.Hear(Reports(drive_status_t::FOLLOWING, 0.28, 11), After(0.3));
  EXPECT_FALSE(dut.Stands(kOrdered, After(0.3)));
  dut.Hear(Reports(drive_status_t::HOLDING, 0.2, kStand), After(0.8));
  EXPECT_FALSE(dut.Stands(kOrdered, After(0.8))) << "it brakes";
  dut.Hear(Reports(drive_status_t::HOLDING, 0, kStand), After(1.3));
  EXPECT_TRUE(dut.Stands(kOrdered, After(1.3)));
  EXPECT_EQ(dut.How(), "the robot stands");
}

TEST(StandConfirmation, ARobotThatHoldsForAnotherReasonMayGoOn) {
  StandConfirmation dut;
  dut.Hear(ToStand());
  dut.Hear(Reports(drive_status_t::HOLDING, 0, 11), After(0.5));
  EXPECT_FALSE(dut.Stands(kOrdered, After(0.5)));
  path_t path = ToStand(13);
  path.n_points = 1;
  dut.Hear(path);
  dut.Hear(Reports(drive_status_t::HOLDING, 0, kStand), After(1));
  EXPECT_FALSE(dut.Stands(kOrdered, After(1))) << "somebody had it go on";
}

TEST(StandConfirmation, AReportFromBeforeTheOrderOrALongTimeAgoIsNone) {
  StandConfirmation dut;
  dut.Hear(ToStand());
  dut.Hear(Reports(drive_status_t::HOLDING, 0, kStand), After(-0.1));
  EXPECT_FALSE(dut.Stands(kOrdered, After(0)));
  dut.Hear(Reports(drive_status_t::HOLDING, 0, kStand), After(0.5));
  EXPECT_TRUE(dut.Stands(kOrdered, After(1)));
  EXPECT_FALSE(dut.Stands(kOrdered, After(4)));
}

TEST(StandConfirmation, ALatchedStopAndAPersonAtTheSticksCountToo) {
  StandConfirmation stopped, driven;
  drive_status_t latched = Reports(drive_status_t::HOLDING, 0, 11);
  latched.estop = true;
  stopped.Hear(latched, After(0.5));
  EXPECT_TRUE(stopped.Stands(kOrdered, After(0.5)));
  EXPECT_THAT(stopped.How(), HasSubstr("emergency stop"));
  driven.Hear(Reports(drive_status_t::OPERATED, 0.3, 11), After(0.5));
  EXPECT_TRUE(driven.Stands(kOrdered, After(0.5)));
  EXPECT_THAT(driven.How(), HasSubstr("by hand"));
}

TEST(StandConfirmation, InABlackoutItSaysForHowLongNothingWasHeard) {
  StandConfirmation dut, never;
  dut.Hear(Reports(drive_status_t::FOLLOWING, 0.28, 11), After(-4));
  dut.Hear(ToStand());
  EXPECT_FALSE(dut.IsOverdue(kOrdered, After(2)));
  for (const StandConfirmation* c : {&dut, &never}) EXPECT_TRUE(c->IsOverdue(kOrdered, After(3.1)));
  EXPECT_EQ(dut.WhyNot(After(-5), After(3.1)),
            "nothing is heard from the robot for 7 s: it goes on as it was told until the radio is back");
  EXPECT_THAT(never.WhyNot(After(-5), After(3.1)), HasSubstr("for 8 s: it goes on"));
}

TEST(StandConfirmation, ReportsThatDoNotConfirmItAreOverdueLater) {
  StandConfirmation dut;
  dut.Hear(ToStand());
  for (int i = 1; i <= 16; ++i) {
    EXPECT_FALSE(dut.IsOverdue(kOrdered, After(0.5 * i)));
    dut.Hear(Reports(drive_status_t::FOLLOWING, 0.28, 11), After(0.5 * i));
  }
  EXPECT_TRUE(dut.IsOverdue(kOrdered, After(8.2)));
  EXPECT_THAT(dut.WhyNot(kOrdered, After(8.2)), HasSubstr("it reports 0.28 m/s"));
}

}  // namespace
}  // namespace priamos::cli
