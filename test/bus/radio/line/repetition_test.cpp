#include "bus/radio/line/repetition.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace priamos::bus::radio {
namespace {

constexpr Time kStart{Duration(1'000'000)};
constexpr Duration kFrame{12'500}, kTick{1000};

Time After(Duration d) {
  return kStart + d;
}

TEST(Repetition, NothingGoesFirstThatDoesNotWait) {
  Repetition dut(kStart);
  EXPECT_FALSE(dut.GoesFirst(kStart));
  dut.Step(true, kStart);
  EXPECT_TRUE(dut.GoesFirst(kStart));
  dut.Step(false, After(kTick));
  EXPECT_FALSE(dut.GoesFirst(After(kTick)));
}

TEST(Repetition, CountsTheTimeWithoutAnAnswerAlsoWhenNewEventsComeBetween) {
  Repetition dut(kStart);
  dut.NoteUnanswered(true, After(kTick));
  dut.Step(true, After(kTick));
  dut.Step(false, After(2 * kTick));
  dut.NoteUnanswered(true, After(5 * kTick));
  EXPECT_TRUE(dut.UnansweredFor(4 * kTick, After(5 * kTick)));
  EXPECT_FALSE(dut.UnansweredFor(5 * kTick, After(5 * kTick)));
  dut.NoteUnanswered(false, After(6 * kTick));
  dut.NoteUnanswered(true, After(7 * kTick));
  EXPECT_FALSE(dut.UnansweredFor(kTick, After(7 * kTick)));
}

/// Share of the line that repetitions take from `from` to `until` when the other frames always have
/// something.
double Share(Repetition& dut, Duration from, Duration until) {
  Duration repeated{};
  for (Duration t = from; t < until;) {
    dut.Step(true, After(t));
    const bool first = dut.GoesFirst(After(t));
    const Duration took = first ? kFrame : 8 * kFrame;
    if (first) {
      dut.OnRepeated(After(t), took);
      repeated += took;
    } else {
      dut.OnOthersTurn(After(t));
    }
    t += took;
  }
  return Seconds(repeated) / Seconds(until - from);
}

TEST(Repetition, TakesAllOfTheLineAtFirstThenHalfOfIt) {
  Repetition dut(kStart);
  EXPECT_EQ(Share(dut, Duration(0), kRepeatAtOnce), 1);
  EXPECT_NEAR(Share(dut, kRepeatAtOnce, kRepeatAtOnce + FromSeconds(20)), 0.5, 0.02);
}

TEST(Repetition, OthersDoNotWaitLongerThanThatForTheirTurn) {
  Repetition dut(kStart);
  Duration longest{}, since{};
  for (Duration t{}; t < FromSeconds(5); t += kTick) {
    // A new urgent event, acknowledged shortly before the line would be shared.
    dut.Step(t % Duration(290'000) >= kTick, After(t));
    if (dut.GoesFirst(After(t))) {
      longest = std::max(longest, t - since);
    } else if (t % Duration(290'000) >= kTick) {
      dut.OnOthersTurn(After(t));
      since = t;
    }
  }
  EXPECT_LE(longest, kRepeatAtOnce + kTick);
}

}  // namespace
}  // namespace priamos::bus::radio
