#include "cli/terminal/topic_statistics.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "priamos/odometry_t.hpp"

namespace priamos::cli {
namespace {

using std::chrono::milliseconds;

class Statistics : public testing::Test {
 protected:
  static Time At(int ms) { return FromUtime(1'000'000) + milliseconds(ms); }
  const bus::Schema schema_ = bus::OwnTypes();
  TopicStatistics dut_{schema_, std::chrono::seconds(2)};
  const std::vector<std::byte> good_ = bus::Encode(odometry_t{});
};

TEST_F(Statistics, RateJitterBandwidthAndAge) {
  for (int i = 0; i <= 100; ++i) dut_.Add(At(20 * i + (i % 2 ? 2 : 0)), "ODOMETRY", good_);
  const auto rows = dut_.Rows(At(2010));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].type, "priamos.odometry_t");
  EXPECT_EQ(rows[0].messages, 101u);
  EXPECT_NEAR(rows[0].rate_hz, 50, 0.1);
  EXPECT_NEAR(rows[0].jitter_s, 0.002, 1e-4);  // intervals of 22 and 18 ms
  EXPECT_NEAR(rows[0].age_s, 0.010, 1e-6);
  EXPECT_NEAR(rows[0].bandwidth_bytes_s, 50.0 * static_cast<double>(good_.size()), 100);
}

TEST_F(Statistics, WhatIsSilentHasNoRate) {
  for (int i = 0; i < 10; ++i) dut_.Add(At(20 * i), "ODOMETRY", good_);
  const auto rows = dut_.Rows(At(10'000));
  EXPECT_EQ(rows[0].rate_hz, 0);
  EXPECT_GT(rows[0].age_s, 9);
}

TEST_F(Statistics, DamagedAndUnknownAreUndecodable) {
  auto damaged = good_;
  damaged.pop_back();
  dut_.Add(At(0), "A", good_);
  dut_.Add(At(1), "A", damaged);
  dut_.Add(At(2), "B", std::span(good_).first(3));
  const auto rows = dut_.Rows(At(3));
  EXPECT_EQ(rows[0].undecodable, 1u);
  EXPECT_EQ(rows[1].undecodable, 1u);
  EXPECT_EQ(rows[1].type, "?");
}

TEST_F(Statistics, AFloodOfNamesTakesBoundedMemory) {
  const int n = 3 * static_cast<int>(TopicStatistics::kMaxChannels);
  for (int i = 0; i < n; ++i) dut_.Add(At(i), fmt::format("C{}", i), good_);
  const auto rows = dut_.Rows(At(n));
  EXPECT_EQ(rows.size(), TopicStatistics::kMaxChannels + 1);
  std::uint64_t messages = 0;
  for (const auto& row : rows) messages += row.messages;
  EXPECT_EQ(messages, static_cast<std::uint64_t>(n));
}

}  // namespace
}  // namespace priamos::cli
