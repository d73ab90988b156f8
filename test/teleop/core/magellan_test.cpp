#include "teleop/core/magellan.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <vector>

namespace priamos::teleop {
namespace {

constexpr int kFull = 350;

std::vector<MagellanPacket> Parse(const std::string& bytes, int* skipped = nullptr) {
  MagellanParser dut;
  std::vector<MagellanPacket> packets;
  for (const char c : bytes)
    if (auto packet = dut.Add(c)) packets.push_back(*packet);
  if (skipped) *skipped = dut.skipped();
  return packets;
}

TEST(Magellan, MotionIsTwentyFourNibblesAroundTheMiddle) {
  EXPECT_EQ(MagellanMotion({}, kFull), "d" + std::string("8000").append("80008000800080008000") + "\r");
  Stick stick;
  stick.axis[2] = 1;  // up is y, 350 = 0x15e
  EXPECT_EQ(MagellanMotion(stick, kFull).substr(5, 4), "815>");
}

RC_GTEST_PROP(Magellan, AStickComesBack, ()) {
  Stick stick;
  for (double& a : stick.axis) a = *rc::gen::inRange(-kFull, kFull + 1) / double(kFull);
  const auto keys = *rc::gen::inRange<std::uint32_t>(0, 1u << 12);  // as many keys as it has
  const auto packets = Parse(MagellanMotion(stick, kFull) + MagellanKeys(keys));
  RC_ASSERT(packets.size() == 2u);
  const auto axes = StickAxes(packets[0].motion.value(), kFull);
  for (std::size_t i = 0; i < kAxes; ++i) RC_ASSERT(std::abs(axes[i] - stick.axis[i]) < 1e-9);
  RC_ASSERT(packets[1].keys == keys);
}

TEST(Magellan, PushedAwayIsForwardAndTurnedLeftIsTurn) {
  EXPECT_THAT(StickAxes({0, 0, -kFull, 0, kFull, 0}, kFull), testing::ElementsAre(1, 0, 0, 0, 0, 1));
  EXPECT_THAT(StickAxes({-kFull, 0, 0, 0, 0, 0}, kFull), testing::ElementsAre(0, 1, 0, 0, 0, 0));
}

TEST(Magellan, AnswersAreNoPacketsAndJunkIsCounted) {
  int skipped = 0;
  EXPECT_TRUE(Parse("v  MAGELLAN\rm3\r\r", &skipped).empty());
  EXPECT_EQ(skipped, 0);
  EXPECT_TRUE(Parse("d8000\rxyz\rk12\rkAAA\r" + std::string(500, '8') + "\r", &skipped).empty());
  EXPECT_EQ(skipped, 5);
}

TEST(Magellan, AfterJunkTheNextPacketIsUnderstood) {
  EXPECT_EQ(Parse("80008000\r" + MagellanMotion({}, kFull)).size(), 1u);
}

}  // namespace
}  // namespace priamos::teleop
