#include "head/core/motion/follow_up.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

constexpr double kNear_m = 0.9, kFar_m = 1.5, kDrives_m_s = 0.3;

Time At(double s) {
  return Time{} + FromSeconds(s);
}

TEST(FollowUp, WhatWasFoundFromNearIsLookedAtAgain) {
  FollowUp dut({});
  EXPECT_FALSE(dut.Due(kNear_m, kDrives_m_s, At(1)));
  dut.Answered(true, At(1));
  EXPECT_FALSE(dut.Due(kNear_m, kDrives_m_s, At(1.2)));
  EXPECT_TRUE(dut.Due(kNear_m, kDrives_m_s, At(1.3)));
  EXPECT_FALSE(dut.Due(kNear_m, kDrives_m_s, At(2))) << "one look for each that found it";
  dut.Answered(true, At(1.4));
  EXPECT_TRUE(dut.Due(kNear_m, kDrives_m_s, At(1.8)));
}

TEST(FollowUp, WhatIsLostIsNotFollowed) {
  FollowUp dut({});
  dut.Answered(true, At(1));
  dut.Answered(false, At(1.1));
  EXPECT_FALSE(dut.Due(kNear_m, kDrives_m_s, At(2)));
}

TEST(FollowUp, FromAfarOrStandingItWaitsForOrders) {
  for (const auto& [distance_m, speed_m_s] : {std::pair(kFar_m, kDrives_m_s), std::pair(kNear_m, 0.0)}) {
    FollowUp dut({});
    dut.Answered(true, At(1));
    EXPECT_FALSE(dut.Due(distance_m, speed_m_s, At(1.5)));
    EXPECT_FALSE(dut.Due(kNear_m, kDrives_m_s, At(1.6))) << "until it is found again";
  }
}

TEST(FollowUp, CanBeSwitchedOff) {
  FollowUp dut({.within_m = 0});
  dut.Answered(true, At(1));
  EXPECT_FALSE(dut.Due(kNear_m, kDrives_m_s, At(2)));
}

}  // namespace
}  // namespace priamos::head
