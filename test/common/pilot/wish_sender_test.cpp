#include "common/pilot/wish_sender.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace priamos {
namespace {

using std::chrono::milliseconds;
using State = WishSender::Stick;

TEST(WishSender, SaysNothingBeforeTheStickWasInTheHand) {
  WishSender dut(milliseconds(40), milliseconds(500));
  for (int t = 0; t < 1000; t += 10)
    EXPECT_FALSE(dut.Step(State::kReleased, false, FromUtime(0) + milliseconds(t)));
}

TEST(WishSender, TheFirstZeroWaitsForNoPeriod) {
  WishSender dut(milliseconds(40), milliseconds(500));
  EXPECT_TRUE(dut.Step(State::kDeflected, false, FromUtime(0)));
  EXPECT_FALSE(dut.Step(State::kDeflected, false, FromUtime(10'000)));
  EXPECT_TRUE(dut.Step(State::kReleased, false, FromUtime(20'000)));
  EXPECT_FALSE(dut.Step(State::kReleased, false, FromUtime(30'000)));
  EXPECT_TRUE(dut.Step(State::kReleased, false, FromUtime(60'000)));
  EXPECT_TRUE(dut.Step(State::kReleased, false, FromUtime(100'000)));
  EXPECT_FALSE(dut.Step(State::kReleased, false, FromUtime(9'000'000)));
}

TEST(WishSender, AJumpWaitsForHalfAPeriod) {
  WishSender dut(milliseconds(40), milliseconds(500));
  EXPECT_TRUE(dut.Step(State::kDeflected, false, FromUtime(0)));
  EXPECT_FALSE(dut.Step(State::kDeflected, true, FromUtime(10'000)));
  EXPECT_TRUE(dut.Step(State::kDeflected, true, FromUtime(20'000)));
  EXPECT_FALSE(dut.Step(State::kDeflected, false, FromUtime(50'000)));
  EXPECT_TRUE(dut.Step(State::kDeflected, false, FromUtime(60'000)));
}

/// However the stick is shaken, no more than one command per period and one per release goes out, so that
/// the radio's budget holds.
RC_GTEST_PROP(WishSender, AShakyStickDoesNotFloodTheRadio, ()) {
  WishSender dut(milliseconds(40), milliseconds(500));
  int sent = 0, releases = 0;
  bool was_deflected = false;
  for (int t = 0; t < 4000; t += 10) {
    const bool deflected = *rc::gen::arbitrary<bool>();
    if (was_deflected && !deflected) ++releases;
    was_deflected = deflected;
    sent += dut.Step(deflected ? State::kDeflected : State::kReleased, false, FromUtime(0) + milliseconds(t));
  }
  RC_ASSERT(sent <= 4000 / 40 + 2 * releases + 2);
}

}  // namespace
}  // namespace priamos
