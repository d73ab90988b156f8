#include "planner/core/missions/lost_watch.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace priamos::planner {
namespace {

RobotPose Known(double sigma_m, double sigma_deg) {
  RobotPose pose;
  pose.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, std::pow(Radians(sigma_deg), 2);
  return pose;
}

void SeeElsewhere(LostWatch& dut, int times) {
  LookResult result;
  result.implausible = true;
  for (int i = 0; i < times; ++i) dut.Note(result);
}

TEST(LostWatch, AKnownPoseIsNotLost) {
  EXPECT_FALSE(LostWatch().Why(Known(0.2, 5)));
  EXPECT_FALSE(LostWatch().Why(std::nullopt));
}

TEST(LostWatch, APoseThatTheRobotItselfDoesNotKnowIsLost) {
  EXPECT_TRUE(LostWatch().Why(Known(0.6, 1)));
  EXPECT_TRUE(LostWatch().Why(Known(0.1, 15)));
}

TEST(LostWatch, OneWrongDoorMakesNobodyLostManyDo) {
  LostWatch dut;
  SeeElsewhere(dut, 2);
  EXPECT_FALSE(dut.Why(Known(0.1, 1)));
  SeeElsewhere(dut, 2);
  EXPECT_TRUE(dut.Why(Known(0.1, 1)));
}

TEST(LostWatch, ALandmarkThatFitsAndAPoseThatIsSetAreWaysOut) {
  LookResult fits, placed;
  fits.ok = placed.placed = true;
  for (const LookResult& way_out : {fits, placed}) {
    LostWatch dut;
    SeeElsewhere(dut, 5);
    dut.Note(way_out);
    EXPECT_FALSE(dut.Why(Known(0.1, 1)));
  }
}

}  // namespace
}  // namespace priamos::planner
