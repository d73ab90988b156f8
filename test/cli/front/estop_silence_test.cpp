#include "cli/front/estop_silence.hpp"

#include <gmock/gmock.h>

namespace priamos::cli {
namespace {

using testing::HasSubstr;

TEST(EstopSilence, TheOtherBusIsNamedWhenTheRobotIsThere) {
  EXPECT_EQ(WhyNoAnswer({"offboard", {"HEALTH"}}, EstopEar{"onboard", {"DRIVE_STATUS", "POSE"}}),
            "DRIVE_STATUS is heard on onboard: --bus onboard");
  EXPECT_EQ(WhyNoAnswer({"offboard", {}}, EstopEar{"onboard", {"HEALTH", "POSE"}}),
            "nothing is heard there; onboard carries 2 channels: --bus onboard");
}

TEST(EstopSilence, WhatIsHeardIsNamedAndALongListIsCut) {
  EXPECT_EQ(WhyNoAnswer({"offboard", {"A", "B", "C", "D", "E", "F", "G"}}, std::nullopt),
            "heard there: A, B, C, D, E and 2 more; but no DRIVE_STATUS of a robot");
  EXPECT_THAT(WhyNoAnswer({"offboard", {"DRIVE_STATUS"}}, std::nullopt), HasSubstr("shows no change"));
}

TEST(EstopSilence, OnSilentBusesTheNextStepIsNamed) {
  EXPECT_THAT(WhyNoAnswer({"offboard", {}}, EstopEar{"onboard", {}}),
              AllOf(HasSubstr("nothing is heard"), HasSubstr("priamos doctor")));
}

}  // namespace
}  // namespace priamos::cli
