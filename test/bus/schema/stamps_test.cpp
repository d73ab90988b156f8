#include "bus/schema/stamps.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {
namespace {

template <class T>
T Shifted(const T& message, std::int64_t by_us) {
  static const Schema schema = OwnTypes();
  auto bytes = Encode(message);
  EXPECT_TRUE(ShiftStamps(*schema.Find(static_cast<std::uint64_t>(T::getHash())), bytes, by_us));
  return Decode<T>(bytes);
}

clock_report_t Report(std::vector<std::int64_t> heard) {
  clock_report_t message{};
  message.utime = 5'000'000;
  message.host = "a name before the arrays";
  message.count = static_cast<std::int8_t>(heard.size());
  message.heard_id.resize(heard.size(), 7);
  message.utime_arrived.resize(heard.size(), 0);
  message.ahead_s.resize(heard.size(), 1);
  message.uncertainty_s.resize(heard.size(), 2);
  message.utime_heard = std::move(heard);
  return message;
}

TEST(ShiftStamps, EveryTimeStampAndNothingElse) {
  pose_correction_t fix{};
  fix.utime = 10'000'000;
  fix.utime_exposure = 9'000'000;
  const auto shifted = Shifted(fix, -250'000);
  EXPECT_EQ(shifted.utime, 9'750'000);
  EXPECT_EQ(shifted.utime_exposure, 8'750'000);
  fix.utime = shifted.utime;
  fix.utime_exposure = shifted.utime_exposure;
  EXPECT_EQ(Encode(fix), Encode(shifted));
}

TEST(ShiftStamps, InArraysBehindTexts) {
  const auto shifted = Shifted(Report({1'000'000, 2'000'000}), 500);
  EXPECT_EQ(shifted.utime, 5'000'500);
  EXPECT_EQ(shifted.utime_heard, (std::vector<std::int64_t>{1'000'500, 2'000'500}));
  EXPECT_EQ(shifted.heard_id, (std::vector<std::int32_t>{7, 7}));
}

TEST(ShiftStamps, ZeroIsNoTime) {
  EXPECT_EQ(Shifted(pose_t{}, 1'000'000).utime, 0);
}

TEST(ShiftStamps, AStampStaysWithinItsBits) {
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  const auto shifted = Shifted(Report({kMost - 1, kLeast + 1}), 5);
  EXPECT_EQ(shifted.utime_heard, (std::vector<std::int64_t>{kMost, kLeast + 6}));
  EXPECT_EQ(Shifted(Report({kLeast + 1}), -5).utime_heard.front(), kLeast);
}

TEST(ShiftStamps, DamagedBytesStay) {
  const Schema schema = OwnTypes();
  const Struct& type = *schema.Find("pose_t");
  auto bytes = Encode(pose_t{});
  bytes.pop_back();
  const auto before = bytes;
  EXPECT_FALSE(ShiftStamps(type, bytes, 1));
  EXPECT_EQ(bytes, before);
}

RC_GTEST_PROP(ShiftStampsProperty, ThereAndBackIsTheSame, (std::int32_t by_us)) {
  const auto heard =
      *rc::gen::container<std::vector<std::int64_t>>(rc::gen::inRange<std::int64_t>(1LL << 40, 1LL << 52));
  const auto message = Report(
      {heard.begin(), heard.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(heard.size(), 16))});
  RC_ASSERT(Encode(Shifted(Shifted(message, by_us), -std::int64_t{by_us})) == Encode(message));
}

}  // namespace
}  // namespace priamos::bus
