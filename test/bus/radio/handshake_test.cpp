#include "bus/radio/handshake.hpp"

#include <gtest/gtest.h>

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);
Time After(double s) {
  return kStart + FromSeconds(s);
}

constexpr std::uint32_t kTable = 77;

Handshake Make(std::uint64_t first_nonce, bool floor_due = false) {
  return {kTable, [n = first_nonce]() mutable { return n++; }, floor_due, kStart};
}

TEST(Handshake, ThreeHellosMakeAnEpoch) {
  Handshake a = Make(100), b = Make(200);
  Hello hello = a.Take(1, Reception::kUnusable, kStart);
  EXPECT_FALSE(b.OnHello(hello).fresh);
  ASSERT_TRUE(b.HelloDue(Reception::kHeard, kStart));
  const auto agreed_a = a.OnHello(b.Take(2, Reception::kUnusable, kStart)).agreed;
  ASSERT_TRUE(agreed_a);
  ASSERT_TRUE(a.HelloDue(Reception::kHeard, kStart));
  const auto agreed_b = b.OnHello(a.Take(1, Reception::kHeard, kStart)).agreed;
  ASSERT_TRUE(agreed_b);
  EXPECT_EQ(agreed_a->own, agreed_b->peer);
  EXPECT_EQ(agreed_a->peer, agreed_b->own);
  EXPECT_EQ(a.sent() + b.sent(), 0U);  // as long as nobody says that they have left
  EXPECT_EQ(b.received(), 2U);
}

TEST(Handshake, AnEndWithoutEpochAsksAtOnceAndRepeats) {
  Handshake dut = Make(1);
  EXPECT_FALSE(dut.HelloDue(Reception::kHeard, kStart));
  EXPECT_TRUE(dut.HelloDue(Reception::kUnusable, kStart));
  EXPECT_TRUE(dut.Take(9, Reception::kUnusable, kStart).need);
  EXPECT_FALSE(dut.HelloDue(Reception::kUnusable, After(0.299)));
  EXPECT_TRUE(dut.HelloDue(Reception::kUnusable, After(0.3)));
}

TEST(Handshake, SilenceIsAnnouncedOnceASecond) {
  Handshake dut = Make(1);
  EXPECT_FALSE(dut.Take(9, Reception::kSilent, kStart).need);
  EXPECT_FALSE(dut.HelloDue(Reception::kSilent, After(0.999)));
  EXPECT_TRUE(dut.HelloDue(Reception::kSilent, After(1)));
}

TEST(Handshake, CutOffItIsDueAgain) {
  Handshake dut = Make(1);
  dut.Take(9, Reception::kUnusable, kStart);
  dut.Return();
  EXPECT_TRUE(dut.HelloDue(Reception::kHeard, kStart));
}

TEST(Handshake, ProvokedAnswersAreLimited) {
  Handshake dut = Make(1);
  const Hello replay{.table_hash = kTable, .nonce = 5, .need = true};
  int answers = 0;
  for (int ms = 0; ms < 10'000; ++ms) {
    dut.OnHello(replay);
    if (!dut.HelloDue(Reception::kHeard, After(0.001 * ms))) continue;
    dut.Take(9, Reception::kHeard, After(0.001 * ms));
    ++answers;
  }
  EXPECT_LE(answers, 4 + 20);
  EXPECT_GE(answers, 20);
}

TEST(Handshake, AnotherTableIsNotedWhenItsHelloIsFreshAndAnsweredUntilThen) {
  Handshake dut = Make(100);
  Hello other{.table_hash = kTable + 1, .nonce = 5, .need = true};
  EXPECT_FALSE(dut.OnHello(other).fresh);
  EXPECT_FALSE(dut.table_mismatch());
  ASSERT_TRUE(dut.HelloDue(Reception::kHeard, kStart));
  other.echo = dut.Take(9, Reception::kHeard, kStart).nonce;
  EXPECT_TRUE(dut.OnHello(other).fresh);
  EXPECT_TRUE(dut.table_mismatch());
  dut.OnData();
  EXPECT_FALSE(dut.OnHello(other).fresh);  // what it echoes has proven it once
  EXPECT_FALSE(dut.table_mismatch());
}

TEST(Handshake, AHelloOfAnAgreementThatIsDoneIsNotAnswered) {
  Handshake a = Make(100), b = Make(200);
  b.OnHello(a.Take(1, Reception::kUnusable, kStart));
  const Hello old = b.Take(2, Reception::kUnusable, kStart);
  ASSERT_TRUE(a.OnHello(old).agreed);
  a.OnEpochChanged();
  a.Take(1, Reception::kHeard, kStart);
  EXPECT_FALSE(a.OnHello(old).fresh);
  EXPECT_TRUE(a.HelloDue(Reception::kHeard, kStart));  // the answer may have been lost
  a.Take(1, Reception::kHeard, kStart);
  a.OnData();
  EXPECT_FALSE(a.OnHello(old).fresh);
  EXPECT_FALSE(a.HelloDue(Reception::kHeard, kStart));
}

TEST(Handshake, TheFloorIsDueUntilAFrameShowsThatItIsKnown) {
  Handshake dut = Make(1, true);
  EXPECT_TRUE(dut.floor_due());
  dut.OnData();
  EXPECT_FALSE(dut.floor_due());
}

TEST(Handshake, AfterAHelloTheFloorHasItsTurn) {
  Handshake dut = Make(1, true);
  EXPECT_FALSE(dut.floor_waits());
  ASSERT_TRUE(dut.HelloDue(Reception::kUnusable, kStart));
  dut.Take(9, Reception::kUnusable, kStart);
  EXPECT_TRUE(dut.floor_waits());
  EXPECT_FALSE(dut.HelloDue(Reception::kUnusable, After(5)));
  dut.OnFloorSent();
  EXPECT_TRUE(dut.HelloDue(Reception::kUnusable, After(5)));
  dut.Take(9, Reception::kUnusable, After(5));
  dut.OnData();
  EXPECT_FALSE(dut.floor_waits());
}

TEST(Handshake, AfterASwitchItRepeatsUntilAFrameComes) {
  Handshake dut = Make(1);
  dut.Take(9, Reception::kHeard, kStart);
  dut.OnEpochChanged();
  EXPECT_TRUE(dut.HelloDue(Reception::kHeard, After(0.3)));
  dut.OnData();
  EXPECT_FALSE(dut.HelloDue(Reception::kHeard, After(0.3)));
}

}  // namespace
}  // namespace priamos::bus::radio
