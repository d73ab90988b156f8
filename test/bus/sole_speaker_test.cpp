#include "bus/sole_speaker.hpp"

#include <gtest/gtest.h>

namespace priamos::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const Time kStart = FromUtime(1'000'000'000);

TEST(SoleSpeaker, FindsASenderOfItsChannelsAfterTheGrace) {
  SoleSpeaker dut({"WHEEL_STATE", "CAMERA_FRAME"});
  dut.Hear(7, "POSE", kStart);
  EXPECT_FALSE(dut.Find(kStart + seconds(1))) << "anybody may speak that";
  dut.Hear(8, "CAMERA_FRAME", kStart);
  EXPECT_FALSE(dut.Find(kStart + milliseconds(499)));
  EXPECT_EQ(dut.Find(kStart + milliseconds(499), Duration::zero())->sender, 8u)
      << "who only asks need not wait";
  const auto found = dut.Find(kStart + milliseconds(500));
  ASSERT_TRUE(found) << "one message is enough";
  EXPECT_EQ(found->sender, 8u);
  EXPECT_EQ(found->channel, "CAMERA_FRAME");
}

TEST(SoleSpeaker, ExcusesWhoClaimsTheSameRoleAsLongAsItDoes) {
  SoleSpeaker dut({"WHEEL_STATE"});
  dut.Hear(7, "WHEEL_STATE", kStart);
  dut.Excuse(7, kStart + milliseconds(200));
  dut.Hear(7, "WHEEL_STATE", kStart + milliseconds(300));
  EXPECT_FALSE(dut.Find(kStart + seconds(1)));
  dut.Hear(7, "WHEEL_STATE", kStart + seconds(3));
  EXPECT_TRUE(dut.Find(kStart + seconds(4))) << "it claims no more, and speaks";
}

}  // namespace
}  // namespace priamos::bus
