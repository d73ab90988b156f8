#include "bus/clocks/log_time.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <limits>

namespace priamos::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

constexpr Time kBegin{std::chrono::hours(480'000)};

class LogTimeTest : public testing::Test {
 protected:
  LogTimeTest() { dut_.Hear(kBegin); }
  LogTime dut_;
};

TEST(LogTime, IsUnknownBeforeTheFirstMessage) {
  LogTime dut;
  dut.Hear(Time{});
  EXPECT_FALSE(dut.now());
}

TEST_F(LogTimeTest, IsThatOfTheNewestMessage) {
  dut_.Hear(kBegin + milliseconds(20));
  dut_.Hear(kBegin + milliseconds(10));
  EXPECT_EQ(dut_.now(), kBegin + milliseconds(20));
}

TEST_F(LogTimeTest, OneWrongStampDoesNothing) {
  dut_.Hear(kBegin + minutes(30));
  dut_.Hear(kBegin + milliseconds(10));
  dut_.Hear(kBegin + minutes(30));
  dut_.Hear(kBegin - minutes(30));
  EXPECT_EQ(dut_.now(), kBegin + milliseconds(10));
  EXPECT_FALSE(dut_.went_back());
}

TEST_F(LogTimeTest, AGapOfTheLogIsFollowed) {
  for (int i = 0; i < LogTime::kWitnesses; ++i) dut_.Hear(kBegin + minutes(30) + milliseconds(i));
  EXPECT_EQ(dut_.now(), kBegin + minutes(30) + milliseconds(LogTime::kWitnesses - 1));
}

TEST_F(LogTimeTest, ALogThatIsPlayedAgainIsNoticed) {
  dut_.Hear(kBegin + seconds(1));
  for (int i = 0; i < LogTime::kWitnessesBack; ++i) {
    EXPECT_FALSE(dut_.went_back());
    dut_.Hear(kBegin - seconds(20) + milliseconds(i));
  }
  EXPECT_TRUE(dut_.went_back());
  dut_.Hear(kBegin + seconds(2));
  EXPECT_TRUE(dut_.went_back()) << "what the end of the log sends meanwhile changes nothing";
}

TEST_F(LogTimeTest, MessagesFarBehindAreCounted) {
  dut_.Hear(kBegin - minutes(1));
  dut_.Hear(kBegin);
  dut_.Hear(kBegin - minutes(2));
  EXPECT_EQ(dut_.far_behind(), 2U);
}

TEST(LogTime, ALogOfASecondThatIsPlayedAgainIsNoticed) {
  LogTime dut;
  for (int play = 0; play < 2; ++play)
    for (std::uint64_t i = 0; i < 5; ++i) {
      EXPECT_FALSE(dut.went_back());
      dut.Hear(kBegin + milliseconds(200 * i), i);
    }
  EXPECT_TRUE(dut.went_back());
}

TEST_F(LogTimeTest, TheMessagesByWhichThatIsNoticedAreHandedOut) {
  BeginningAgain dut;
  const auto hear = [&](Time stamp, const std::string& channel) {
    dut_.Hear(stamp);
    dut.Note(dut_, channel, {});
  };
  hear(kBegin - minutes(1), "LATE");
  hear(kBegin + seconds(1), "NOW");
  EXPECT_TRUE(dut.Take().empty());
  hear(kBegin - minutes(1), "FIRST");
  for (int i = 1; i < LogTime::kWitnessesBack + 7; ++i) hear(kBegin - seconds(59), "NEXT");
  const auto taken = dut.Take();
  ASSERT_EQ(taken.size(), LogTime::kWitnessesBack + 7U);
  EXPECT_EQ(taken.front().channel, "FIRST");
  EXPECT_TRUE(dut.Take().empty());
}

RC_GTEST_PROP(LogTimeProperty, NeverRunsBackNorOverflows, (const std::vector<std::int64_t>& stamps)) {
  LogTime dut;
  dut.Hear(kBegin);
  for (const std::int64_t stamp : stamps) {
    const Time before = *dut.now();
    dut.Hear(FromUtime(stamp));
    RC_ASSERT(*dut.now() >= before);
  }
}

}  // namespace
}  // namespace priamos::bus
