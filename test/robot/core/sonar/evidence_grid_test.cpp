#include "robot/core/sonar/evidence_grid.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using testing::IsEmpty;
using testing::Not;

class EvidenceGridTest : public testing::Test {
 protected:
  void Hear(const Pose2& odom_from_sonar, double range_m, int times) {
    for (int i = 0; i < times; ++i) dut_.Add(odom_from_sonar, range_m, now_ += milliseconds(100));
  }
  std::vector<Eigen::Vector2d> Things(const Pose2& odom_from_base = {}) const {
    return dut_.Things(odom_from_base, now_);
  }
  /// How far things reach to both sides of the x axis.
  double Breadth() const {
    double breadth = 0;
    for (const auto& thing : Things()) breadth = std::max(breadth, std::abs(thing.y()));
    return breadth;
  }

  Time now_ = FromUtime(1'000'000'000);
  EvidenceGrid dut_{EvidenceGridConfig{}};
};

TEST_F(EvidenceGridTest, OneEchoIsNoThing) {
  Hear({}, 1.0, 1);
  EXPECT_THAT(Things(), IsEmpty());
}

TEST_F(EvidenceGridTest, EchoesFromOnePlaceMakeAThingAtTheirRange) {
  Hear({}, 1.0, 5);
  ASSERT_THAT(Things(), Not(IsEmpty()));
  for (const auto& thing : Things()) EXPECT_NEAR(thing.norm(), 1.0, 0.041);
}

TEST_F(EvidenceGridTest, AWideArcNeedsMoreEchoes) {
  Hear({}, 1.9, 4);
  EXPECT_THAT(Things(), IsEmpty());
  Hear({}, 1.9, 10);
  EXPECT_THAT(Things(), Not(IsEmpty()));
}

TEST_F(EvidenceGridTest, EchoesFromBeyondItsReachSayNothingOfAPlace) {
  Hear({}, 2.5, 50);
  EXPECT_THAT(Things(), IsEmpty());
}

TEST_F(EvidenceGridTest, ABeamThatSeesOnBehindItClearsAThing) {
  Hear({}, 1.0, 5);
  const double before = Breadth();
  Hear({}, 2.4, 20);
  EXPECT_GT(before, 0);
  for (const auto& thing : Things())
    EXPECT_GT(std::abs(std::atan2(thing.y(), thing.x())), Radians(4)) << "the middle of the beam is free";
}

TEST_F(EvidenceGridTest, BeamsFromTwoPlacesNarrowAThing) {
  Hear({}, 1.2, 6);
  const double one = Breadth();
  // Sensors beside it see past the ends of the arc.
  Hear({0, 0.12, 0}, 2.4, 20);
  Hear({0, -0.12, 0}, 2.4, 20);
  Hear({}, 1.2, 6);
  EXPECT_LT(Breadth(), one);
}

TEST_F(EvidenceGridTest, StaysInPlaceWhileTheBaseMoves) {
  Hear({}, 1.0, 5);
  const auto here = Things(), there = Things({0.5, 0, kPi / 2});
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i)
    EXPECT_LT((Pose2{0.5, 0, kPi / 2} * there[i] - here[i]).norm(), 1e-9);
}

TEST_F(EvidenceGridTest, ForgetsWhatNothingRenews) {
  Hear({}, 1.0, 5);
  now_ += std::chrono::seconds(31);
  EXPECT_THAT(Things(), IsEmpty());
}

TEST_F(EvidenceGridTest, CellsFarAwayDoNotComeBackElsewhere) {
  Hear({}, 1.0, 5);
  for (double x = 4.5; x < 16; x += 0.5) EXPECT_THAT(Things({x, 0, 0}), IsEmpty()) << x;
}

}  // namespace
}  // namespace priamos::robot
