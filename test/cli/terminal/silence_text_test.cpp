#include "cli/terminal/silence_text.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

const BusSound kOffboard{"offboard", "udpm://b", {{"POSE", 4}, {"HEALTH", 1}, {"MISSION_STATUS", 0}}};
const BusSound kOnboard{"onboard", "udpm://a", {{"POSE", 50}, {"SONAR_RANGES", 10}}};
const std::vector<std::string> kKnown{"POSE", "HEALTH", "SONAR_RANGES", "PATH", "WHEEL_STATE"};

std::string Text(const std::string& channel, BusSound here = kOffboard,
                 std::optional<BusSound> other = kOnboard) {
  return SilenceText(channel, here, other, kKnown, {"PATH"});
}

TEST(SilenceText, NamesTheBusAndWhoIsNear) {
  EXPECT_EQ(Text("POZE"), "nobody publishes POZE on offboard (udpm://b); nearest: \"POSE\" (4.0 Hz)");
  EXPECT_EQ(
      Text("MISSION_STATS"),
      "nobody publishes MISSION_STATS on offboard (udpm://b); nearest: \"MISSION_STATUS\" (now and then)");
}

TEST(SilenceText, NamesAKnownChannelWhenNoneThatIsHeardIsNear) {
  EXPECT_EQ(Text("WHEL_STATE"),
            "nobody publishes WHEL_STATE on offboard (udpm://b); nearest: \"WHEEL_STATE\"");
  EXPECT_EQ(Text("ELEPHANT"), "nobody publishes ELEPHANT on offboard (udpm://b)");
  EXPECT_EQ(Text("WHEEL_STATE"), "nobody publishes WHEEL_STATE on offboard (udpm://b)") << "rightly spelled";
}

TEST(SilenceText, KnowsWhatTheOtherBusHas) {
  EXPECT_EQ(
      Text("SONAR_RANGES"),
      "nobody publishes SONAR_RANGES on offboard (udpm://b); it is on onboard (10.0 Hz): --bus onboard");
}

TEST(SilenceText, AnEventMayBeSilent) {
  EXPECT_EQ(Text("PATH"), "no PATH on offboard (udpm://b) so far; it is sent when something happens");
}

TEST(SilenceText, SaysWhenNothingIsHeardAtAll) {
  const BusSound silent{"udpm://c", "udpm://c", {}};
  EXPECT_EQ(Text("POSE", silent, std::nullopt),
            "nothing is heard on udpm://c; is anything up (priamos status), and is there a route for "
            "multicast (priamos doctor)?");
  EXPECT_EQ(Text("", silent, kOnboard),
            "nothing is heard on udpm://c; onboard carries 2 channels: --bus onboard");
}

}  // namespace
}  // namespace priamos::cli
