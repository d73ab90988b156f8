#include "robot/core/safety/operator_input.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;

constexpr Time kStart = FromUtime(1'000'000'000);
const LeaseHolder kTeleop{Driver::kTeleop, 3};

DriveCommand Command(int sequence, Time time, const Twist2& twist = {0.3, 0, 0}) {
  return {time, kTeleop, sequence, milliseconds(200), twist};
}

class OperatorInputTest : public testing::Test {
 protected:
  CommandVerdict Take(const DriveCommand& command, Time now = kStart) {
    return dut_.Take(command, true, now);
  }

  OperatorInput dut_{OperatorConfig{}};
};

TEST_F(OperatorInputTest, HasNoCommandAtFirst) {
  EXPECT_FALSE(dut_.Valid(kStart));
  EXPECT_FALSE(dut_.FellSilent(kStart));
}

TEST_F(OperatorInputTest, ObeysACommandUntilItsTimeRunsOut) {
  EXPECT_EQ(Take(Command(1, kStart)), CommandVerdict::kAccepted);
  ASSERT_TRUE(dut_.Valid(kStart + milliseconds(200)));
  EXPECT_EQ(dut_.Valid(kStart)->twist.vx, 0.3);
  EXPECT_FALSE(dut_.Valid(kStart + milliseconds(201)));
  EXPECT_TRUE(dut_.FellSilent(kStart + milliseconds(201)));
}

TEST_F(OperatorInputTest, TheTimeOnTheRadioCounts) {
  EXPECT_EQ(Take(Command(1, kStart), kStart + milliseconds(150)), CommandVerdict::kAccepted);
  EXPECT_FALSE(dut_.Valid(kStart + milliseconds(210))) << "not 200 ms from its arrival";
}

TEST_F(OperatorInputTest, SilenceAfterACommandToStandIsTheNormalEnd) {
  Take(Command(1, kStart, {0, 0, 0}));
  EXPECT_FALSE(dut_.FellSilent(kStart + milliseconds(500)));
}

TEST_F(OperatorInputTest, WhoWasSilentWhileDrivingMovesNothingBeforeHeLetGo) {
  Take(Command(1, kStart));
  const Time back = kStart + milliseconds(200) + milliseconds(301);
  EXPECT_EQ(Take(Command(2, back), back), CommandVerdict::kNotAtRest);
  EXPECT_EQ(Take(Command(3, back + milliseconds(50)), back + milliseconds(50)), CommandVerdict::kNotAtRest);
  EXPECT_EQ(Take(Command(4, back + milliseconds(90), {}), back + milliseconds(90)),
            CommandVerdict::kAccepted);
  EXPECT_EQ(Take(Command(5, back + milliseconds(99)), back + milliseconds(99)), CommandVerdict::kAccepted);
}

TEST_F(OperatorInputTest, HeMustLetGoAlsoWhenHisCommandWasDropped) {
  Take(Command(1, kStart));
  dut_.Drop();
  const Time back = kStart + milliseconds(3000);
  EXPECT_EQ(Take(Command(2, back), back), CommandVerdict::kNotAtRest);
}

TEST_F(OperatorInputTest, AFewLostCommandsInterruptTheDriveWithoutEndingIt) {
  Take(Command(1, kStart));
  const Time back = kStart + milliseconds(450);
  EXPECT_EQ(Take(Command(9, back), back), CommandVerdict::kAccepted);
}

TEST_F(OperatorInputTest, WhoStoodMayBeSilent) {
  Take(Command(1, kStart, {}));
  const Time back = kStart + milliseconds(5000);
  EXPECT_EQ(Take(Command(2, back), back), CommandVerdict::kAccepted);
}

TEST_F(OperatorInputTest, RefusesWithoutLease) {
  EXPECT_EQ(dut_.Take(Command(1, kStart), false, kStart), CommandVerdict::kWithoutLease);
  EXPECT_FALSE(dut_.Valid(kStart));
}

TEST_F(OperatorInputTest, RefusesWhatIsOutOfOrderOrDouble) {
  Take(Command(5, kStart));
  EXPECT_EQ(Take(Command(5, kStart)), CommandVerdict::kOutOfOrder);
  EXPECT_EQ(Take(Command(4, kStart)), CommandVerdict::kOutOfOrder);
  EXPECT_EQ(Take(Command(6, kStart)), CommandVerdict::kAccepted);
}

TEST_F(OperatorInputTest, TheSequenceWrapsAround) {
  Take(Command(65535, kStart));
  EXPECT_EQ(Take(Command(0, kStart)), CommandVerdict::kAccepted);
}

TEST_F(OperatorInputTest, AnotherSessionBeginsItsOwnSequence) {
  Take(Command(500, kStart));
  DriveCommand other = Command(1, kStart);
  other.from.session = 9;
  EXPECT_EQ(Take(other), CommandVerdict::kAccepted);
}

TEST_F(OperatorInputTest, RefusesWhatIsTooOldOrFromTheFuture) {
  EXPECT_EQ(Take(Command(1, kStart - milliseconds(201))), CommandVerdict::kTooOld);
  EXPECT_EQ(Take(Command(2, kStart + milliseconds(60))), CommandVerdict::kTooOld);
}

TEST_F(OperatorInputTest, RefusesValuesOutOfRangeInsteadOfClampingThem) {
  EXPECT_EQ(Take(Command(1, kStart, {5, 0, 0})), CommandVerdict::kOutOfRange);
  EXPECT_EQ(Take(Command(2, kStart, {0.3, std::numeric_limits<double>::quiet_NaN(), 0})),
            CommandVerdict::kOutOfRange);
  EXPECT_EQ(Take(Command(3, kStart, {0, 0, -3})), CommandVerdict::kOutOfRange);
  DriveCommand immortal = Command(4, kStart);
  immortal.time_to_live = milliseconds(10'000);
  EXPECT_EQ(Take(immortal), CommandVerdict::kOutOfRange);
  EXPECT_FALSE(dut_.Valid(kStart));
}

TEST_F(OperatorInputTest, WaitsForTheStickToRestWhenItMust) {
  dut_.RequireRest();
  EXPECT_EQ(Take(Command(1, kStart)), CommandVerdict::kNotAtRest);
  EXPECT_EQ(Take(Command(2, kStart, {0, 0, 0})), CommandVerdict::kAccepted);
  EXPECT_EQ(Take(Command(3, kStart)), CommandVerdict::kAccepted);
}

TEST_F(OperatorInputTest, CountsWhatItRefuses) {
  Take(Command(1, kStart));
  Take(Command(1, kStart));
  Take(Command(2, kStart, {5, 0, 0}));
  EXPECT_EQ(dut_.refused(), 2);
  EXPECT_EQ(dut_.counts()[static_cast<std::size_t>(CommandVerdict::kOutOfOrder)], 1);
}

TEST_F(OperatorInputTest, ADroppedCommandIsNeitherObeyedNorMissed) {
  Take(Command(1, kStart));
  dut_.Drop();
  EXPECT_FALSE(dut_.Valid(kStart));
  EXPECT_FALSE(dut_.FellSilent(kStart + milliseconds(500)));
  EXPECT_EQ(Take(Command(1, kStart)), CommandVerdict::kOutOfOrder);
}

}  // namespace
}  // namespace priamos::robot
