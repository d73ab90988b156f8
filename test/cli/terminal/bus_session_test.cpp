#include "cli/terminal/bus_session.hpp"

#include <gtest/gtest.h>

#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

TEST(BusSession, HasOurTypesAndANodeOnTheBusThatWasChosen) {
  BusOptions options;
  options.bus.bus = "memq://";
  BusSession dut("priamos try", options, "POSE");
  auto poses = dut.node().SubscribeAll(channels::kPose);
  auto publisher = dut.node().Advertise(channels::kPose);
  EXPECT_NE(dut.schema().Find("priamos.pose_t"), nullptr);
  int steps = 0;
  std::size_t heard = 0;
  publisher.Publish(pose_t{});
  testing::internal::CaptureStderr();
  dut.Watch(
      Time::max(), [&] { return heard > 0; },
      [&] {
        ++steps;
        heard += poses.Drain().size();
      });
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_EQ(heard, 1u);
  EXPECT_EQ(steps, 1);
  EXPECT_EQ(told, "") << "too early to speak of silence";
}

}  // namespace
}  // namespace priamos::cli
