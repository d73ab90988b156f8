#include "bus/radio/frame/epoch.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace priamos::bus::radio {
namespace {

struct EpochTest : testing::Test {
  std::uint64_t drawn = 100;
  NonceSource nonces = [this] { return ++drawn; };
  EpochAgreement a{nonces}, b{nonces};
};

TEST_F(EpochTest, ThreeHellosAgree) {
  const auto at_b = b.OnHello(a.Compose(true));
  EXPECT_TRUE(at_b.reply);
  EXPECT_FALSE(at_b.agreed);
  const auto at_a = a.OnHello(b.Compose(false));
  ASSERT_TRUE(at_a.agreed);
  EXPECT_TRUE(at_a.reply);
  const auto last = b.OnHello(a.Compose(false));
  ASSERT_TRUE(last.agreed);
  EXPECT_EQ(last.agreed->own, at_a.agreed->peer);
  EXPECT_EQ(last.agreed->peer, at_a.agreed->own);
  EXPECT_FALSE(last.reply);
}

TEST_F(EpochTest, BothMayBeginAtOnce) {
  const Hello from_a = a.Compose(true), from_b = b.Compose(true);
  a.OnHello(from_b);
  b.OnHello(from_a);
  const auto at_a = a.OnHello(b.Compose(true)), at_b = b.OnHello(a.Compose(true));
  ASSERT_TRUE(at_a.agreed && at_b.agreed);
  EXPECT_EQ(at_a.agreed->own, at_b.agreed->peer);
  EXPECT_EQ(at_a.agreed->peer, at_b.agreed->own);
}

TEST_F(EpochTest, RepeatedHelloChangesNothing) {
  b.OnHello(a.Compose(true));
  a.OnHello(b.Compose(false));
  b.OnHello(a.Compose(false));
  const auto again = b.OnHello(a.Compose(false));
  EXPECT_FALSE(again.agreed);
  EXPECT_FALSE(again.reply);
}

TEST_F(EpochTest, ReplayedFirstHelloCannotChangeTheEpoch) {
  const Hello old = a.Compose(true);
  b.OnHello(old);
  a.OnHello(b.Compose(false));
  b.OnHello(a.Compose(false));
  EXPECT_FALSE(b.OnHello(old).agreed);
}

TEST_F(EpochTest, ReplayedLastHelloCannotChangeTheEpochBack) {
  b.OnHello(a.Compose(true));
  a.OnHello(b.Compose(false));
  const Hello old = a.Compose(false);
  ASSERT_TRUE(b.OnHello(old).agreed);
  EpochAgreement restarted(nonces);  // `a` has lost its state
  b.OnHello(restarted.Compose(true));
  ASSERT_TRUE(restarted.OnHello(b.Compose(false)).agreed);
  ASSERT_TRUE(b.OnHello(restarted.Compose(false)).agreed);
  EXPECT_FALSE(b.OnHello(old).agreed);
}

TEST_F(EpochTest, NumbersOfEarlierAttemptsDoNotKeepTheEndsFromAgreeing) {
  EpochAgreement gone(nonces);
  for (EpochAgreement* end : {&a, &b}) end->OnHello(gone.Compose(true));  // both are paired with a dead end
  bool agreed = false;
  for (int i = 0; i < 4 && !agreed; ++i) {
    b.OnHello(a.Compose(true));
    a.OnHello(b.Compose(true));
    agreed = a.Compose(true).agreed && b.Compose(true).agreed;
  }
  EXPECT_TRUE(agreed);
  EXPECT_EQ(a.Compose(true).echo, b.Compose(true).nonce);
  EXPECT_EQ(b.Compose(true).echo, a.Compose(true).nonce);
}

TEST_F(EpochTest, ANumberMakesOneEpoch) {
  b.OnHello(a.Compose(true));
  a.OnHello(b.Compose(false));
  ASSERT_TRUE(b.OnHello(a.Compose(false)).agreed);
  const std::uint64_t first = b.Compose(false).nonce;
  EpochAgreement other(nonces);
  b.OnHello(other.Compose(true));
  EXPECT_NE(b.Compose(false).nonce, first);
}

TEST_F(EpochTest, AReplayedHelloDoesNotTakeTheAnswerOfANewEnd) {
  const Hello old{.nonce = 7, .need = true};
  ASSERT_TRUE(b.OnHello(old).reply);
  EXPECT_EQ(b.Compose(false).echo, old.nonce);
  const Hello ask = a.Compose(true);
  b.OnHello(ask);
  EXPECT_FALSE(b.OnHello(old).reply);
  EXPECT_EQ(b.Compose(false).echo, ask.nonce);
}

TEST_F(EpochTest, ReplaysOfAHundredEarlierStartsDoNotTakeTheAnswerOfANewEnd) {
  std::vector<Hello> recorded;
  for (int start = 0; start < 100; ++start) {
    recorded.push_back(EpochAgreement(nonces).Compose(true));
    b.OnHello(recorded.back());
    b.Compose(false);
  }
  const Hello hello = a.Compose(true);
  for (const Hello& old : recorded) b.OnHello(old);
  b.OnHello(hello);
  for (const Hello& old : recorded) b.OnHello(old);
  EXPECT_EQ(b.Compose(false).echo, hello.nonce);
}

TEST_F(EpochTest, OldHellosOfTheEndAgreedWithDoNotTakeTheAnswerOfItsNextLife) {
  const Hello asked = a.Compose(true);
  b.OnHello(asked);
  a.OnHello(b.Compose(false));
  const Hello ended = a.Compose(false);
  b.OnHello(ended);
  b.OnData();
  EpochAgreement again(nonces);
  const Hello hello = again.Compose(true);
  b.OnHello(hello);
  for (const Hello& old : {asked, ended}) EXPECT_FALSE(b.OnHello(old).reply);
  EXPECT_EQ(b.Compose(false).echo, hello.nonce);
}

TEST_F(EpochTest, ReplaysDoNotTakeTheHelloThatEndsTheAgreement) {
  b.OnHello(a.Compose(true));
  const Hello answer = b.Compose(false);
  ASSERT_TRUE(a.OnHello(answer).agreed);
  for (std::uint64_t old = 1; old < 10; ++old) a.OnHello({.nonce = old, .need = true});
  EXPECT_TRUE(b.OnHello(a.Compose(false)).agreed);
  for (int lost = 0; lost < 4; ++lost) {
    a.OnHello({.nonce = 77, .need = true});
    const Hello first = a.Compose(false), second = a.Compose(false);
    EXPECT_NE(first.agreed, second.agreed) << "and one that asks is answered in turn: it may be a new life";
  }
}

/// Of old hellos that an end has never heard, as many are answered as there are.
TEST_F(EpochTest, AnEndThatAnswersReplaysWithoutEndAgreesWithOneThatHearsTheAnswers) {
  for (std::uint64_t old = 1; old < 500; ++old) {
    b.OnHello(a.Compose(true));
    b.OnHello({.nonce = old, .need = true});
    a.OnHello(b.Compose(false));
    if (!b.OnHello(a.Compose(true)).agreed) continue;
    EXPECT_EQ(old, 1U);
    b.OnHello({.nonce = 1000, .need = true});
    EXPECT_TRUE(a.OnHello(b.Compose(false)).agreed);
    return;
  }
  FAIL() << "never";
}

TEST_F(EpochTest, WhoAskedBeforeDataCameGetsNoSecondAnswerWhileItComes) {
  b.OnHello(a.Compose(true));
  a.OnHello(b.Compose(false));
  b.OnHello(a.Compose(false));
  const Hello old{.nonce = 7, .need = true};
  EXPECT_TRUE(b.OnHello(old, true, true).reply);
  b.Compose(false);
  b.OnData();
  EXPECT_FALSE(b.OnHello(old, true, true).reply);
  EXPECT_TRUE(b.OnHello(old, true, false).reply);  // in silence it may be true after all
}

TEST_F(EpochTest, AReplayLeavesWhatIsAgreed) {
  b.OnHello(a.Compose(true));
  a.OnHello(b.Compose(false));
  b.OnHello(a.Compose(false));
  const Hello before = b.Compose(false);
  b.OnHello({.nonce = 7, .need = true});
  b.OnData();
  EXPECT_EQ(b.Compose(false), before);
}

TEST_F(EpochTest, AnAnnouncementIsNotAnswered) {
  EXPECT_FALSE(b.OnHello(a.Compose(false)).reply);
}

TEST(TimedNonceTest, IsTheGreaterTheLaterItWasDrawn) {
  const Time noon = FromUtime(1'700'000'000'000'000);
  EXPECT_LT(TimedNonce(~0ULL, noon), TimedNonce(0, noon + FromSeconds(1)));
  EXPECT_NE(TimedNonce(1ULL << 40, noon), TimedNonce(2ULL << 40, noon)) << "chance stays in it";
}

TEST(AskersTest, WhoseNumberWasDrawnLastGetsEverySecondAnswer) {
  constexpr std::uint64_t kSecond = 1ULL << 36;
  Askers dut;
  dut.Add(7 * kSecond);
  for (std::uint64_t replay = 1; replay < 6; ++replay) {
    dut.Add(replay * kSecond);
    EXPECT_EQ(dut.Take(), replay % 2 == 1 ? 7 * kSecond : replay * kSecond);
  }
}

TEST(AskersTest, WhoWasAnsweredComesAfterWhoWasNot) {
  Askers dut;
  dut.Add(1);
  EXPECT_EQ(dut.Take(), 1u);
  dut.Add(2);
  dut.Add(1);
  EXPECT_EQ(dut.Take(), 2u);
}

TEST(AskersTest, DataRefutesThoseAnsweredAlone) {
  constexpr std::uint64_t kSecond = 1ULL << 36;
  Askers dut;
  dut.Add(9 * kSecond);
  EXPECT_EQ(dut.Take(), 9 * kSecond);
  dut.Add(kSecond);
  dut.Refute();
  EXPECT_TRUE(dut.Refuted(9 * kSecond));
  EXPECT_FALSE(dut.Refuted(kSecond));
  EXPECT_FALSE(dut.any());
}

}  // namespace
}  // namespace priamos::bus::radio
