#include "robot/core/safety/collision_stop.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "robot/core/base/twist_slew.hpp"
#include "robot/core/sonar/echo_memory.hpp"
#include "test/robot/support/simulated_base.hpp"
#include "test/robot/support/simulated_sonars.hpp"

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using Points = std::vector<Eigen::Vector2d>;

const CollisionStop kDut{{.margin_m = 0.02, .gap_m = 0.1, .braking = {0.8, 0.1}}, {}};

TEST(CollisionStop, LeavesTheMotionAloneWhereNothingIs) {
  const auto result = kDut.Limit({0.5, 0.1, 0.2}, {});
  EXPECT_EQ(result.scale, 1);
  EXPECT_FALSE(result.nearest);
}

TEST(CollisionStop, StandsAtTheGapBeforeAPointAhead) {
  const auto result = kDut.Limit({0.5, 0, 0}, Points{{0.475 + 0.1, 0}});
  EXPECT_NEAR(result.twist.vx, 0, 1e-9);
}

TEST(CollisionStop, ReportsTheFreeWay) {
  const auto result = kDut.Limit({0.1, 0, 0}, Points{{0.475 + 0.02 + 0.7, 0.3}});
  ASSERT_TRUE(result.nearest);
  EXPECT_NEAR(result.nearest->free_m, 0.7, 2e-3);
}

TEST(CollisionStop, NamesThePointThatItWouldMeetFirst) {
  const Eigen::Vector2d seen{1.2, 0.3}, remembered{0.9, -0.2}, beside{0.6, 0.6};
  const auto of_both = kDut.Limit({0.1, 0, 0}, Points{beside, seen}, Points{remembered});
  ASSERT_TRUE(of_both.nearest);
  EXPECT_EQ(of_both.nearest->point, remembered);
  const auto of_seen = kDut.Limit({0.1, 0, 0}, Points{beside, seen}, Points{{2.0, 0}});
  ASSERT_TRUE(of_seen.nearest);
  EXPECT_EQ(of_seen.nearest->point, seen);
}

TEST(CollisionStop, TheSpeedItAllowsStopsInTheFreeWay) {
  for (double free = 0.1; free < 1; free += 0.05) {
    const auto result = kDut.Limit({2, 0, 0}, Points{{0.475 + 0.02 + free, 0}});
    const double v = result.twist.vx;
    EXPECT_LE(v * 0.1 + v * v / (2 * 0.8), free - 0.1 + 2e-3);
  }
}

TEST(CollisionStop, SlowsDownGraduallyWithTheDistance) {
  double before = 0.5;
  for (double x = 2; x > 0.6; x -= 0.02) {
    const double v = kDut.Limit({0.5, 0, 0}, Points{{x, 0}}).twist.vx;
    EXPECT_LE(v, before + 1e-9);
    EXPECT_GT(v, before - 0.13);
    before = std::min(before, v);
  }
}

TEST(CollisionStop, PointsBesideTheWayDoNotMatter) {
  EXPECT_EQ(kDut.Limit({0.5, 0, 0}, Points{{0.6, 0.42}, {0.6, -0.42}, {0, 0.45}}).scale, 1);
}

TEST(CollisionStop, ScalesTheWholeMotionSoThatThePathStays) {
  const auto result = kDut.Limit({0.4, 0.2, 0.1}, Points{{0.65, 0.1}});
  EXPECT_LT(result.scale, 1);
  EXPECT_NEAR(result.twist.vy / result.twist.vx, 0.5, 1e-9);
  EXPECT_NEAR(result.twist.wz / result.twist.vx, 0.25, 1e-9);
}

TEST(CollisionStop, GuardsSidewaysMotion) {
  EXPECT_NEAR(kDut.Limit({0, 0.4, 0}, Points{{0.2, 0.49}}).scale, 0, 1e-9);
  EXPECT_EQ(kDut.Limit({0, -0.4, 0}, Points{{0.2, 0.49}}).scale, 1);
}

TEST(CollisionStop, GuardsTheCornersWhenTurning) {
  // Beside the front left corner: turning left sweeps over it, turning right does not.
  const Points beside{{0.40, 0.45}};
  EXPECT_LT(kDut.Limit({0, 0, 0.5}, beside).scale, 0.7);
  EXPECT_EQ(kDut.Limit({0, 0, -0.1}, beside).scale, 1);
}

TEST(CollisionStop, LetsTheBaseDriveAwayFromAPointThatIsTooNear) {
  const Points touching{{0.48, 0}};
  EXPECT_EQ(kDut.Limit({0.3, 0, 0}, touching).scale, 0);
  EXPECT_EQ(kDut.Limit({-0.3, 0, 0}, touching).scale, 1);
  EXPECT_EQ(kDut.Limit({0, 0.3, 0}, touching).scale, 1) << "sliding along";
}

TEST(CollisionStop, NothingThatClosesInCountsAsSlidingAlongOnceHalfOfTheMarginIsUsedUp) {
  const Twist2 nearly_along{0.006, 0.3, 0};
  EXPECT_EQ(kDut.Scale(nearly_along, Points{{0.475 + 0.0195, 0}}, {}), 1);
  EXPECT_EQ(kDut.Scale(nearly_along, Points{{0.475 + 0.0099, 0}}, {}), 0);
}

TEST(CollisionStop, NoMotionThatItAllowsAtStandstillDrivesIntoAPoint) {
  EXPECT_TRUE(rc::check([] {
    const auto part = [](double most) { return *rc::gen::inRange(-1000, 1001) / 1000.0 * most; };
    Points points;
    for (int i = 0; i < 5; ++i) points.push_back({part(1.5), part(1.5)});
    for (const auto& point : points) RC_PRE(Footprint().Distance(point) > 0.03);
    const auto result = kDut.Limit({part(0.5), part(0.5), part(0.5)}, points);
    // Obey for the latency, then brake evenly along the same motion.
    Pose2 pose;
    for (double rest = 1, t = 0; rest > 0; t += 0.005) {
      const double speed = std::hypot(result.twist.vx, result.twist.vy) + std::abs(result.twist.wz) * 0.63;
      if (speed < 1e-9) break;
      if (t > 0.1) rest -= 0.8 / speed * 0.005;
      pose = Integrate(pose, {result.twist.vx * rest, result.twist.vy * rest, result.twist.wz * rest}, 0.005);
      for (const auto& point : points) RC_ASSERT(Footprint().Distance(pose.Inverse() * point) > 0);
    }
  }));
}

/// The filter with sonars on a base that has lag and slope.
class GuardedDrive {
 public:
  GuardedDrive(std::uint64_t seed, const Pose2& start, std::vector<Surface> surfaces,
               const SimulatedBase::Errors& errors = SimulatedBase::Errors())
      : base_(seed, start, errors), sonars_(seed, std::move(surfaces)) {}

  SimulatedSonars& sonars() { return sonars_; }
  const SimulatedBase& base() const { return base_; }
  double min_gap() const { return min_gap_; }
  double slowest() const { return slowest_; }

  void Drive(const Twist2& wanted, double seconds) {
    for (int tick = 0; tick < seconds * 50; ++tick) {
      if (tick % 5 == 0) memory_.Add(sonars_.Listen(base_.now(), base_.truth()), base_.truth());
      memory_.Forget(base_.truth(), base_.now());
      const auto points = memory_.Points(base_.truth());
      const auto result = dut_.Limit(slew_.Step(wanted, 0.02), points);
      slew_.SetCommanded(result.twist);
      base_.Command(ToWheelSpeeds({}, result.twist), base_.now());
      base_.Advance(milliseconds(20));
      if (tick % 5 == 0) min_gap_ = std::min(min_gap_, sonars_.Gap(base_.truth()));
      if (tick > 75) slowest_ = std::min(slowest_, base_.twist().vx);
    }
  }

 private:
  SimulatedBase base_;
  SimulatedSonars sonars_;
  EchoMemory memory_{EchoMemoryConfig{}, Footprint{}};
  CollisionStop dut_{CollisionStopConfig{}, Footprint{}};
  TwistSlew slew_{AccelerationLimits{}};
  double min_gap_ = 9, slowest_ = 9;
};

std::vector<Surface> DoorWall() {
  std::vector<Surface> surfaces = BoxSides(3.93, -2, 4.07, -0.45);
  for (const Surface& side : BoxSides(3.93, 0.45, 4.07, 2)) surfaces.push_back(side);
  return surfaces;
}

TEST(CollisionStopWithSonars, PassesADoorWithSixCentimetresOnEachSide) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const double y : {-0.03, 0.0, 0.02}) {
      // Wheels without errors keep to the straight line, so that only the filter decides.
      GuardedDrive run(seed, {1.5, y, 0}, DoorWall(), {0, 0, 0, 0, 1});
      run.Drive({0.3, 0, 0}, 20);
      EXPECT_GT(run.slowest(), std::abs(y) < 0.025 ? 0.06 : 0.01) << seed << ' ' << y;
      EXPECT_GT(run.base().truth().x, 4.7) << seed << ' ' << y;
    }
  }
}

TEST(CollisionStopWithSonars, StopsBeforeABoxInTheOpening) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    GuardedDrive run(seed, {0, 0, 0}, DoorWall());
    run.sonars().Add(BoxSides(4.0, -0.15, 4.3, 0.15));
    run.Drive({0.5, 0, 0}, 12);
    EXPECT_GT(run.min_gap(), 0.02) << seed;
    EXPECT_GT(run.base().truth().x, 2.8) << seed;
    EXPECT_NEAR(run.base().twist().vx, 0, 1e-3) << seed;
  }
}

TEST(CollisionStopWithSonars, StopsBeforeAPersonFromFullSpeed) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    GuardedDrive run(seed, {0, 0, 0}, BoxSides(2.5, 0.1, 2.7, 0.3));
    run.sonars().SetFalseEchoes(0.01);
    run.Drive({0.6, 0, 0}, 12);
    EXPECT_GT(run.min_gap(), 0.02) << seed;
    EXPECT_GT(run.base().truth().x, 1.7) << seed;
  }
}

TEST(CollisionStopWithSonars, StopsBeforeAWallWhateverTheDirection) {
  for (const double heading : {90.0, 180.0, -90.0, 45.0}) {
    GuardedDrive run(2, {0, 0, 0}, BoxSides(-2, -2, 2, 2));
    run.Drive({0.4 * std::cos(Radians(heading)), 0.4 * std::sin(Radians(heading)), 0}, 10);
    EXPECT_GT(run.min_gap(), 0.02) << heading;
    EXPECT_LT(run.min_gap(), 0.3) << heading;
  }
}

TEST(CollisionStopWithSonars, FalseEchoesDoNotStopTheBase) {
  GuardedDrive run(4, {0, 0, 0}, {});
  run.sonars().SetFalseEchoes(0.005);
  run.Drive({0.4, 0, 0}, 20);
  EXPECT_GT(run.base().truth().x, 7.0);
}

}  // namespace
}  // namespace priamos::robot
