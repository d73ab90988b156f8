#include "planner/core/missions/model_queue.hpp"

#include <gtest/gtest.h>

namespace priamos::planner {
namespace {

constexpr Time At(int seconds) {
  return FromUtime(1'000'000'000 + std::int64_t{1'000'000} * seconds);
}

Landmark Door(int id) {
  Landmark door;
  door.id = id;
  return door;
}

int IdOf(const std::optional<Landmark>& model) {
  return model ? model->id : 0;
}

struct ModelQueueTest : testing::Test {
  ModelQueue dut{FromSeconds(10)};
};

TEST_F(ModelQueueTest, SendsOneEachPeriodAndTheNewestWishFirst) {
  dut.Want(Door(1), At(0));
  EXPECT_EQ(IdOf(dut.Next(At(0))), 1);
  dut.Want(Door(2), At(1));
  dut.Want(Door(3), At(2));
  EXPECT_EQ(IdOf(dut.Next(At(9))), 0);
  EXPECT_EQ(IdOf(dut.Next(At(10))), 3);
  EXPECT_EQ(IdOf(dut.Next(At(20))), 2);
  EXPECT_EQ(IdOf(dut.Next(At(30))), 0);
}

TEST_F(ModelQueueTest, WhatIsOnItsWayIsNotSentOnceMore) {
  dut.Want(Door(1), At(0));
  EXPECT_EQ(IdOf(dut.Next(At(0))), 1);
  for (int s = 1; s < 19; ++s) {
    dut.Want(Door(1), At(s));
    EXPECT_EQ(IdOf(dut.Next(At(s))), 0) << s;
  }
  dut.Want(Door(1), At(20));
  EXPECT_EQ(IdOf(dut.Next(At(20))), 1) << "the head was started anew, it seems";
}

TEST_F(ModelQueueTest, AnOldWishIsDropped) {
  dut.Want(Door(1), At(0));
  dut.Want(Door(2), At(0));
  EXPECT_EQ(IdOf(dut.Next(At(0))), 2);
  EXPECT_EQ(IdOf(dut.Next(At(31))), 0);
}

}  // namespace
}  // namespace priamos::planner
