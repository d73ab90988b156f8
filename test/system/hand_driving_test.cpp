// What is promised to an operator, in simulated time: exact, and the same on every machine. What real
// processes, spacenavd and a busy computer add is measured by bench_driving.

#include <algorithm>

#include "test/system/hand_rig.hpp"

namespace priamos {
namespace {

using std::chrono::milliseconds;

void ExpectNothingStale(const HandRig& dut) {
  const Freshness fresh = MeasureFreshness(dut.wheels, dut.commands, milliseconds(20));
  EXPECT_GT(fresh.motions, 0);
  EXPECT_EQ(fresh.stale, 0) << "the wheels turned though no drive command was valid";
  EXPECT_LE(Seconds(fresh.oldest), 0.27);
}

TEST(HandDriving, AStickThatMovesReachesTheWheelsInAMomentBeyondTheLine) {
  HandRig dut({});
  dut.DriveAtFullSpeed();
  // 25 bytes of a drive command, and the latency of the emulated modems.
  constexpr double kLine_s = 25 * 10 / 9600. + 0.005;
  std::vector<double> took_s;
  for (int i = 0; i < 20; ++i) {
    dut.hand.axis = {};
    dut.Wait(dut.rng.Uniform(0.5, 0.6));
    const Time pushed = dut.now();
    dut.hand.axis[0] = i % 2 == 0 ? -0.6 : 0.6;
    ASSERT_TRUE(dut.Until([&] { return std::abs(dut.Forward()) > 0.05; }, 2));
    took_s.push_back(Seconds(dut.now() - pushed));
  }
  std::sort(took_s.begin(), took_s.end());
  EXPECT_LE(took_s[18], kLine_s + 0.060) << "p95";
  ExpectNothingStale(dut);
}

TEST(HandDriving, LettingGoUnpluggingAndTheDeathOfTeleopStopTheWheels) {
  HandRig dut({});
  for (const std::string end : {"released", "unplugged", "killed", "released", "unplugged", "killed"}) {
    SCOPED_TRACE(end);
    ASSERT_NO_FATAL_FAILURE(dut.DriveAtFullSpeed());
    const Time ended = dut.now();
    if (end == "released") dut.hand.axis = {};
    if (end == "unplugged") dut.mouse_plugged = false;
    if (end == "killed") {
      dut.Kill("teleop", "offboard");
      dut.ForgetRange();
    }
    dut.Wait(1);
    EXPECT_LE(dut.ToStandstill(ended), 0.300);
    if (end == "killed") dut.Begin("teleop", "offboard");
    dut.Wait(1);
    EXPECT_LE(dut.ToStandstill(ended), 0.300) << "with the hand still on the stick";
    dut.mouse_plugged = true;
    dut.hand = {};
  }
  ExpectNothingStale(dut);
}

TEST(HandDriving, ARadioThatIsCutStopsTheWheelsAndDoesNotStartThemAgain) {
  HandRig::Options options;
  // So long that the operator's end notices: a hand that still pushes then must let go first.
  for (const double from_s : {8.0, 23.013, 38.031}) options.cuts.push_back({from_s, from_s + 3});
  HandRig dut(options);
  for (const auto& cut : options.cuts) {
    ASSERT_NO_FATAL_FAILURE(dut.DriveAtFullSpeed());
    while (dut.since_start_s() < cut.from_s - 0.2) {
      dut.hand.axis[0] = dut.truth.x_m > 2 ? -1 : 1;
      dut.Wait(std::min(0.1, cut.from_s - 0.15 - dut.since_start_s()));
    }
    dut.Wait(cut.from_s - dut.since_start_s());
    ASSERT_GT(std::abs(dut.Forward()), 0.5);
    const Time ended = dut.now();
    dut.Wait(2.9);
    EXPECT_LE(dut.ToStandstill(ended), 0.300);
    dut.Wait(3);
    EXPECT_LE(dut.ToStandstill(ended), 0.300) << "the hand is still on the stick";
    dut.hand = {};
  }
  ExpectNothingStale(dut);
}

TEST(HandDriving, AnEstopStopsTheWheelsAlsoThroughAFullRadioHoweverOften) {
  HandRig dut({.saturated = true});
  for (int i = 0; i < 3; ++i) {
    ASSERT_NO_FATAL_FAILURE(dut.DriveAtFullSpeed());
    const Time pressed = dut.now();
    if (i % 2 == 0) {
      dut.hand.buttons |= HandRig::kEstopKey;
    } else {
      dut.SayEstop(estop_t::STOP);
    }
    dut.Wait(0.5);
    EXPECT_LE(dut.ToStandstill(pressed), 0.150);
    dut.hand.buttons &= ~HandRig::kEstopKey;
    dut.Wait(1);
    EXPECT_LE(dut.ToStandstill(pressed), 0.150) << "the hand pushes on";
    dut.hand = {};
    dut.SayEstop(estop_t::REARM);
    ASSERT_TRUE(dut.Until([&] { return !dut.status.estop; }, 4));
  }
  ExpectNothingStale(dut);
}

/// Re-armed and stopped again within a second, by several people: none of it waits for its turn.
TEST(HandDriving, ManyEstopsWithinASecondAreAllObeyedAtOnce) {
  HandRig dut({});
  ASSERT_NO_FATAL_FAILURE(dut.DriveAtFullSpeed());
  for (int i = 0; i < 4; ++i) {
    const Time said = dut.now();
    dut.SayEstop(estop_t::STOP);
    ASSERT_TRUE(dut.Until([&] { return dut.onboard_status.estop; }, 2));
    EXPECT_LE(Seconds(dut.now() - said), 0.250) << i << "th stop, by the status that comes 10 times a second";
    dut.SayEstop(estop_t::REARM);
    ASSERT_TRUE(dut.Until([&] { return !dut.onboard_status.estop; }, 2));
  }
}

class HandDrivingCrash : public testing::TestWithParam<int> {};

TEST_P(HandDrivingCrash, TheBaseStandsOrGoesOnAndTheProcessIsUsefulAgain) {
  const auto& [name, bus] = HandRig::kAll[GetParam()];
  HandRig dut({});
  ASSERT_NO_FATAL_FAILURE(dut.DriveAtFullSpeed());
  const Time killed = dut.now();
  dut.Kill(name, bus);
  if (std::string(name) == "teleop") dut.ForgetRange();
  dut.Wait(0.5);
  dut.hand = {};
  dut.Wait(0.8);
  if (std::string(name) != "world") {
    EXPECT_LT(dut.speed(), 0.02);
  }
  dut.Begin(name, bus);
  dut.Wait(2);
  EXPECT_LE(dut.ToStandstill(killed), 0.5 + 0.3);
  EXPECT_LT(dut.speed(), 0.02);
  ExpectNothingStale(dut);
  ASSERT_NO_FATAL_FAILURE(dut.DriveAtFullSpeed()) << "it drives again";
}

std::string Name(const testing::TestParamInfo<int>& info) {
  const auto& [name, bus] = HandRig::kAll[info.param];
  return std::string(bus) + "_" + name;
}

INSTANTIATE_TEST_SUITE_P(EveryProcess, HandDrivingCrash, testing::Range(0, 7), Name);

}  // namespace
}  // namespace priamos
