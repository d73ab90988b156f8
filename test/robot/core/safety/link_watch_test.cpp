#include "robot/core/safety/link_watch.hpp"

#include <gtest/gtest.h>

namespace priamos::robot {
namespace {

TEST(LinkWatch, ALinkThatWasNeverDownIsNotDown) {
  LinkWatch dut;
  EXPECT_EQ(dut.DownFor(FromUtime(5)), Duration::zero());
  dut.Update(false, FromUtime(5));
  EXPECT_EQ(dut.DownFor(FromUtime(6)), Duration::zero());
}

TEST(LinkWatch, TheTimeCountsFromWhenItWentDown) {
  LinkWatch dut;
  dut.Update(true, FromUtime(1000));
  EXPECT_EQ(dut.DownFor(FromUtime(1000)), Duration(1)) << "down, and not for 0";
  dut.Update(true, FromUtime(3000));
  EXPECT_EQ(dut.DownFor(FromUtime(5000)), Duration(4000));
}

TEST(LinkWatch, ALinkThatWasUpBetweenBeginsAnew) {
  LinkWatch dut;
  dut.Update(true, FromUtime(1000));
  dut.Update(false, FromUtime(2000));
  dut.Update(true, FromUtime(3000));
  EXPECT_EQ(dut.DownFor(FromUtime(5000)), Duration(2000));
}

}  // namespace
}  // namespace priamos::robot
