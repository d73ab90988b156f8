#include "head/core/doors/door_tracks.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "common/random.hpp"

namespace priamos::head {
namespace {

constexpr double kSigma_m = 0.02;

Time At(double s) {
  return FromUtime(1'000'000'000) + FromSeconds(s);
}

DoorSighting Sighting(double x_m, double y_m, double yaw_rad, double closed = 0) {
  DoorSighting sighting;
  sighting.door.base_from_door = {x_m, y_m, yaw_rad};
  sighting.door.covariance = kSigma_m * kSigma_m * Eigen::Matrix2d::Identity();
  sighting.door.width_m = 0.9;
  sighting.door.log_odds = 10;
  sighting.state.log_likelihood[0] = closed;
  return sighting;
}

TEST(DoorTracks, ADoorIsBelievedWhenTwoLooksShowIt) {
  DoorTracks dut;
  dut.Add(std::array{Sighting(2, 1, kPi / 2)}, {0, 0, 0}, At(0));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_FALSE(dut.IsBelieved(dut.tracks()[0]));
  dut.Add(std::array{Sighting(1.5, 1, kPi / 2)}, {0.5, 0, 0}, At(2));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_TRUE(dut.IsBelieved(dut.tracks()[0]));
  EXPECT_EQ(dut.tracks()[0].seen, At(2));
  EXPECT_NEAR(dut.tracks()[0].place.map_from_thing.x, 2, 1e-9);
}

TEST(DoorTracks, DoorsThatAreApartAreTwo) {
  DoorTracks dut;
  dut.Add(std::array{Sighting(2, 1, kPi / 2), Sighting(3.2, 1, kPi / 2)}, {}, At(0));
  ASSERT_EQ(dut.tracks().size(), 2u);
  EXPECT_NE(dut.tracks()[0].id, dut.tracks()[1].id);
}

TEST(DoorTracks, TheMeanOfManyLooksIsBetterThanOneAndDoesNotBoast) {
  Rng rng = Rng::Stream(3, "tracks");
  double squares = 0, nees = 0;
  constexpr int kDoors = 200;
  for (int i = 0; i < kDoors; ++i) {
    DoorTracks dut;
    for (int look = 0; look < 4; ++look)
      dut.Add(std::array{Sighting(2 + rng.Normal(kSigma_m), 1 + rng.Normal(kSigma_m), kPi / 2)}, {},
              At(look));
    const DoorTrack& track = dut.tracks().at(0);
    const Eigen::Vector2d off = track.place.map_from_thing.translation() - Eigen::Vector2d(2, 1);
    squares += off.squaredNorm();
    nees += off.dot(track.place.covariance.inverse() * off);
  }
  EXPECT_LT(squares / kDoors, 2 * kSigma_m * kSigma_m / 3);
  EXPECT_LT(nees / kDoors, 2.4);
}

TEST(DoorTracks, WhatContradictsAllBeforeIsWhereTheDoorIs) {
  DoorTracks dut;
  for (int look = 0; look < 3; ++look) dut.Add(std::array{Sighting(2, 1, kPi / 2)}, {}, At(look));
  dut.Add(std::array{Sighting(2.4, 1, kPi / 2)}, {}, At(4));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_NEAR(dut.tracks()[0].place.map_from_thing.x, 2.4, 1e-9);
}

TEST(DoorTracks, ASightingThatKnowsNothingOfItsPlaceIsLeftOut) {
  DoorTracks dut;
  DoorSighting vague = Sighting(2, 1, kPi / 2);
  vague.door.covariance *= 100;
  dut.Add(std::array{vague}, {}, At(0));
  EXPECT_TRUE(dut.tracks().empty());
}

TEST(DoorTracks, ALeafThatMovedIsToldAfterAFewLooks) {
  DoorTracks dut;
  for (int look = 0; look < 20; ++look) dut.Add(std::array{Sighting(2, 1, kPi / 2, 4)}, {}, At(look));
  EXPECT_EQ(dut.StateOf(dut.tracks()[0]), DoorState::kClosed);
  for (int look = 20; look < 23; ++look) dut.Add(std::array{Sighting(2, 1, kPi / 2, -4)}, {}, At(look));
  EXPECT_NE(dut.StateOf(dut.tracks()[0]), DoorState::kClosed);
}

TEST(DoorTracks, ForgetsAndKeepsNoMoreThanItMay) {
  DoorTrackOptions options;
  options.most = 2;
  DoorTracks dut(options);
  for (int i = 0; i < 3; ++i) dut.Add(std::array{Sighting(2 + 2 * i, 1, kPi / 2)}, {}, At(i));
  ASSERT_EQ(dut.tracks().size(), 2u);
  EXPECT_NEAR(dut.tracks()[0].place.map_from_thing.x, 4, 1e-9) << "the oldest has gone";
  dut.Forget();
  EXPECT_TRUE(dut.tracks().empty());
}

}  // namespace
}  // namespace priamos::head
