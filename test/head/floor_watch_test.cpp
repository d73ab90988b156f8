#include "head/floor_watch.hpp"

#include <gmock/gmock.h>

#include "common/geometry.hpp"
#include "head/head_app.hpp"
#include "test/head/head_on_a_bench.hpp"
#include "test/support/laser_floor.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Bench = HeadOnABench<HeadApp>;

constexpr int kThirdWithLaser = 12;  // bits of a trigger

TEST(FloorWatch, BetweenLooksTheThirdCameraWatchesTheLaserLine) {
  HeadConfig config;
  config.laser.rate_hz = 5;
  HeadModel table = Bench::NearlyDrawn();
  table.lasers = support::NominalLaserFloor().lasers;
  Bench head(config, table);
  head.Run(4);
  EXPECT_NEAR(head.counters.tilt_rad, Radians(config.laser.tilt_deg), 1e-9);
  ASSERT_GT(head.triggers.size(), 5u);
  for (const auto& trigger : head.triggers) EXPECT_EQ(trigger.cameras, kThirdWithLaser);
  EXPECT_EQ(head.obstacles.Drain().size(), head.triggers.size()) << "every picture is reported";
  head.SendLook(7, 3);
  head.Run(1);
  EXPECT_EQ(head.fixes.Drain().size(), 1u) << "a look has the head at once";
}

TEST(FloorWatch, WatchingTheLaserNeedsItsPlane) {
  HeadConfig config;
  config.laser.rate_hz = 5;
  EXPECT_THAT(
      support::ThrownReason([&] { Bench{config}; }),
      AllOf(HasSubstr("kastor.yaml: lasers: expected the planes"), HasSubstr("`priamos calibrate --laser`")));
}

TEST(FloorWatch, WatchingTheLaserNeedsATiltThatShowsItsLine) {
  HeadConfig config;
  config.laser.rate_hz = 5;
  config.laser.tilt_deg = -20;
  HeadModel table = Bench::NearlyDrawn();
  table.lasers = support::NominalLaserFloor().lasers;
  EXPECT_THAT(support::ThrownReason([&] { Bench(config, table); }),
              AllOf(HasSubstr("laser.tilt_deg: expected a tilt"), HasSubstr("got -20.0 degrees")));
}

TEST(FloorWatch, AHeadThatIsCalibratedNeedsNoPlaneYet) {
  HeadConfig config;
  config.laser.rate_hz = 5;
  config.mode = "calibrate";
  Bench head;
  EXPECT_NO_THROW(FloorWatch(config, HeadModel{}, head.context));
}

}  // namespace
}  // namespace priamos::head
