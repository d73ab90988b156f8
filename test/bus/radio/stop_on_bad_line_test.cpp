#include <gtest/gtest.h>

#include <algorithm>

#include "bus/radio/line/repetition.hpp"
#include "link_pair.hpp"

// An emergency stop on a line that damages most frames, with as much else to send as the line carries.

namespace priamos::bus::radio {
namespace {

struct BadLine {
  double bit_error_rate;
  double most_s;
  int late;  ///< stops of 400 that may take longer
};

class StopOnBadLine : public testing::TestWithParam<BadLine> {};

/// Offers what fills both directions.
void Load(LinkPair& pair, int step) {
  if (step % 50 == 0) pair.offboard.link->Offer(kDriveDown, Text("drive"), pair.now);
  if (step % 100 == 0) pair.onboard.link->Offer(kPoseUp, Text("0123456789"), pair.now);
  if (step % 1000 == 0) {
    pair.onboard.link->Offer(kSlowUp, Text(std::string(100, 's')), pair.now);
    pair.offboard.link->Offer(kEventDown, Text(std::string(60, 'e')), pair.now);
  }
}

/// Times from offer to delivery [s] of `stops`, each offered when the one before has come.
std::vector<double> Latencies(LinkPair& pair, int stops) {
  std::vector<double> latencies;
  int step = 0;
  pair.each_step = [&] { Load(pair, step++); };
  for (int i = 0; i < stops; ++i) {
    pair.Run(0.2 + 0.1 * pair.rng.Uniform(0, 1));
    const Time offered = pair.now;
    const std::size_t before = pair.onboard.TextsOf(kStopDown).size();
    pair.offboard.link->Offer(kStopDown, Text("!"), pair.now);
    if (!pair.RunUntil(20, [&] { return pair.onboard.TextsOf(kStopDown).size() > before; })) break;
    latencies.push_back(Seconds(pair.now - offered));
    pair.onboard.received.clear();
    pair.offboard.received.clear();
  }
  return latencies;
}

TEST_P(StopOnBadLine, ComesInTime) {
  LinkPair pair;
  pair.Run(2);
  LineConfig bad;
  bad.bit_error_rate = GetParam().bit_error_rate;
  pair.lines = LinePair(bad, Rng::Stream(1, "up"), Rng::Stream(1, "down"), pair.now);
  constexpr int kStops = 400;
  const auto latencies = Latencies(pair, kStops);
  ASSERT_EQ(latencies.size(), std::size_t{kStops});
  const auto late = std::count_if(latencies.begin(), latencies.end(),
                                  [&](double latency_s) { return latency_s > GetParam().most_s; });
  EXPECT_LE(late, GetParam().late) << "of " << kStops << ", worst "
                                   << *std::max_element(latencies.begin(), latencies.end());
}

INSTANTIATE_TEST_SUITE_P(Lines, StopOnBadLine,
                         testing::Values(BadLine{1e-3, 0.06, 1}, BadLine{3e-3, 0.1, 2},
                                         BadLine{1e-2, 0.3, 2}));

TEST(UrgentEvent, IsRepeatedUntilItIsAcknowledgedAndNotLonger) {
  LinkPair pair;
  pair.Run(2);
  const std::uint64_t before = pair.offboard.link->Status(pair.now).resent;
  pair.offboard.link->Offer(kStopDown, Text("!"), pair.now);
  pair.Run(1);
  EXPECT_EQ(pair.onboard.TextsOf(kStopDown).size(), 1U);
  EXPECT_LE(pair.offboard.link->Status(pair.now).resent - before, 3U);
}

TEST(UrgentEvent, WithoutAcknowledgementsLeavesOthersTheirTurn) {
  LinkPair pair;
  pair.Run(2);
  pair.lose_up = [](auto) { return true; };
  pair.offboard.link->Offer(kStopDown, Text("!"), pair.now);
  for (int i = 1; i <= 3; ++i) {
    const Time offered = pair.now;
    pair.offboard.link->Offer(kEventDown, Text(std::string(60, 'e')), pair.now);
    const auto came = [&] { return pair.onboard.TextsOf(kEventDown).size() == std::size_t(i); };
    ASSERT_TRUE(pair.RunUntil(Seconds(kRepeatAtOnce) + 0.3, came)) << Seconds(pair.now - offered);
  }
  EXPECT_EQ(pair.onboard.TextsOf(kStopDown).size(), 1U);
}

}  // namespace
}  // namespace priamos::bus::radio
