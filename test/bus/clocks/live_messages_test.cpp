#include "bus/clocks/live_messages.hpp"

#include <gmock/gmock.h>

#include "bus/own_types.hpp"
#include "bus/wire/typed_message.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;

constexpr Time kNow{std::chrono::hours(480'000)};
constexpr std::uint64_t kSender = std::uint64_t{0x0100007f} << 16 | 5;  // 127.0.0.1

class LiveMessagesTest : public testing::Test {
 protected:
  bool IsLive(Time stamp, std::uint64_t sender = kSender) {
    health_t message{};
    message.utime = ToUtime(stamp);
    message.process = "recorder";
    return dut_.IsLive(sender, "HEALTH", Encode(message), kNow);
  }
  const Schema schema_ = OwnTypes();
  std::vector<std::string> told_;
  LiveMessages dut_{schema_, [this](const std::string& sentence) { told_.push_back(sentence); }};
};

TEST_F(LiveMessagesTest, AreThoseOfThePresent) {
  EXPECT_TRUE(IsLive(kNow - milliseconds(100)));
  EXPECT_TRUE(IsLive(kNow + milliseconds(1)));
  EXPECT_FALSE(IsLive(kNow - LiveMessages::kNow));
  EXPECT_FALSE(IsLive(kNow + seconds(3600))) << "a log of a computer whose clock was ahead";
  EXPECT_FALSE(IsLive(Time{}));
  EXPECT_FALSE(dut_.IsLive(kSender, "FOREIGN", std::vector<std::byte>(12, std::byte{7}), kNow));
}

TEST_F(LiveMessagesTest, OfEachSenderItIsSaidOnce) {
  IsLive(kNow - seconds(60));
  EXPECT_TRUE(told_.empty());
  for (int i = 0; i < 3; ++i) IsLive(kNow);
  EXPECT_THAT(told_, ElementsAre(testing::StartsWith("HEALTH of recorder at ")));
  for (std::uint64_t i = 0; i < 1000; ++i) IsLive(kNow, i);
  EXPECT_LE(told_.size(), 32U) << "anybody may send";
}

TEST_F(LiveMessagesTest, MayBeUnheardOf) {
  LiveMessages silent(schema_, nullptr);
  pose_t pose{};
  pose.utime = ToUtime(kNow);
  EXPECT_TRUE(silent.IsLive(kSender, "POSE", Encode(pose), kNow));
}

}  // namespace
}  // namespace priamos::bus
