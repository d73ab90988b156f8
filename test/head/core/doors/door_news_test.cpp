#include "head/core/doors/door_news.hpp"

#include <gtest/gtest.h>

#include <set>

namespace priamos::head {
namespace {

Time At(double s) {
  return FromUtime(1'000'000'000) + FromSeconds(s);
}

DoorSighting Sighting(double x_m, double closed = 0) {
  DoorSighting sighting;
  sighting.door.base_from_door = {x_m, 1, kPi / 2};
  sighting.door.covariance = 1e-4 * Eigen::Matrix2d::Identity();
  sighting.state.log_likelihood[0] = closed;
  return sighting;
}

void SeeTwice(DoorTracks& doors, double x_m, double s) {
  for (int i = 0; i < 2; ++i) doors.Add(std::array{Sighting(x_m)}, {}, At(s));
}

TEST(DoorNews, ADoorIsToldWhenItIsBelievedAndThenInTurn) {
  DoorTracks doors;
  DoorNews dut;
  doors.Add(std::array{Sighting(2)}, {}, At(0));
  EXPECT_FALSE(dut.Next(doors, At(0.1)));
  doors.Add(std::array{Sighting(2)}, {}, At(1));
  ASSERT_TRUE(dut.Next(doors, At(1.1)));
  EXPECT_FALSE(dut.Next(doors, At(3))) << "the radio carries one every 5 s";
  EXPECT_TRUE(dut.Next(doors, At(6.2))) << "the radio may have lost the first";
}

TEST(DoorNews, WhatIsNewGoesFirst) {
  DoorTracks doors;
  DoorNews dut;
  SeeTwice(doors, 2, 0);
  ASSERT_TRUE(dut.Next(doors, At(0)));
  SeeTwice(doors, 4, 1);
  for (int i = 0; i < 3; ++i) doors.Add(std::array{Sighting(4, 4)}, {}, At(2));  // it is closed
  const auto first = dut.Next(doors, At(5));
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->map_from_door.x, 4, 0.01);
  for (int i = 0; i < 3; ++i) doors.Add(std::array{Sighting(2, 4)}, {}, At(6));
  const auto changed = dut.Next(doors, At(10));
  ASSERT_TRUE(changed);
  EXPECT_NEAR(changed->map_from_door.x, 2, 0.01);
}

TEST(DoorNews, AllHaveTheirTurnAndOldOnesEnd) {
  DoorTracks doors;
  DoorNews dut;
  for (int i = 0; i < 3; ++i) SeeTwice(doors, 2 + 2 * i, 0);
  std::set<int> told;
  for (int i = 0; i < 3; ++i) told.insert(dut.Next(doors, At(5.0 * i + 0.1))->id);
  EXPECT_EQ(told.size(), 3u);
  EXPECT_FALSE(dut.Next(doors, At(1000)));
}

}  // namespace
}  // namespace priamos::head
