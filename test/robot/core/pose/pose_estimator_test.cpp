#include "robot/core/pose/pose_estimator.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <limits>
#include <vector>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr Time kStart = FromUtime(1'000'000'000);
const Pose2 kDoor{5, 1, 0.1};

Eigen::Matrix3d FixCovariance() {
  return Eigen::Vector3d(4e-4, 1e-4, 2e-5).asDiagonal();
}

class PoseEstimatorTest : public testing::Test {
 protected:
  static PoseEstimatorConfig Config() {
    PoseEstimatorConfig config;
    config.initial = {.x_m = 1, .y_m = 0.5, .yaw_deg = 0};
    return config;
  }
  static OdometryStep Step(int index, const Twist2& twist = {0.4, 0.05, 0.1}) {
    OdometryStep step{.from = At(index), .to = At(index + 1), .twist = twist};
    step.noise.diagonal() << 1e-6, 2e-6, 5e-7;
    return step;
  }
  static Time At(int index) { return kStart + index * milliseconds(20); }
  static LandmarkFix Fix(Time exposure, const Pose2& truth, int id = 1) {
    return {exposure, id, truth.Inverse() * kDoor, FixCovariance(), kDoor};
  }
  static void Drive(PoseEstimator& estimator, int from, int to) {
    for (int i = from; i < to; ++i) estimator.Move(Step(i));
  }
  static void ExpectSame(const PoseEstimate& a, const PoseEstimate& b) {
    EXPECT_NEAR(a.pose.x, b.pose.x, 1e-9);
    EXPECT_NEAR(a.pose.y, b.pose.y, 1e-9);
    EXPECT_NEAR(a.pose.yaw, b.pose.yaw, 1e-9);
    EXPECT_LT((a.covariance - b.covariance).norm(), 1e-12);
  }

  PoseEstimator dut_{Config()};
};

TEST_F(PoseEstimatorTest, SaysNothingBeforeTheFirstStep) {
  EXPECT_FALSE(dut_.newest());
  EXPECT_EQ(dut_.Apply(Fix(kStart, {1, 0.5, 0})).verdict, FixVerdict::kTooNew);
}

TEST_F(PoseEstimatorTest, StartsWithTheSigmaOfAUniformErrorInsideTheBounds) {
  dut_.Move(Step(0, {}));
  const PoseEstimate estimate = *dut_.newest();
  EXPECT_EQ(estimate.pose.x, 1);
  EXPECT_NEAR(std::sqrt(estimate.covariance(0, 0)), 0.2 / std::sqrt(3), 1e-4);
  EXPECT_NEAR(estimate.YawSigma(), Radians(5) / std::sqrt(3), 1e-3);
}

TEST_F(PoseEstimatorTest, ALateFixGivesTheSameAsOneThatCameAtOnce) {
  PoseEstimator prompt{Config()};
  Drive(dut_, 0, 100);
  Drive(prompt, 0, 40);
  const LandmarkFix fix = Fix(At(40), {1.4, 0.62, 0.1});
  EXPECT_EQ(prompt.Apply(fix).verdict, FixVerdict::kApplied);
  Drive(prompt, 40, 100);
  EXPECT_EQ(dut_.Apply(fix).verdict, FixVerdict::kApplied);
  ExpectSame(*dut_.newest(), *prompt.newest());
}

TEST_F(PoseEstimatorTest, TheOrderInWhichTwoFixesArriveDoesNotMatter) {
  PoseEstimator other{Config()};
  Drive(dut_, 0, 100);
  Drive(other, 0, 100);
  const LandmarkFix first = Fix(At(30), {1.3, 0.6, 0.09}, 1), second = Fix(At(70), {1.65, 0.7, 0.17}, 2);
  dut_.Apply(first);
  dut_.Apply(second);
  other.Apply(second);
  other.Apply(first);
  ExpectSame(*dut_.newest(), *other.newest());
}

TEST_F(PoseEstimatorTest, TwoFixesOfOneInstantBothCount) {
  Drive(dut_, 0, 50);
  dut_.Apply(Fix(At(30), {1.3, 0.6, 0.09}, 1));
  const double sigma = dut_.newest()->YawSigma();
  EXPECT_EQ(dut_.Apply(Fix(At(30), {1.3, 0.6, 0.09}, 2)).verdict, FixVerdict::kApplied);
  EXPECT_LT(dut_.newest()->YawSigma(), sigma);
  EXPECT_EQ(dut_.Apply(Fix(At(40), {1.4, 0.62, 0.1}, 3)).verdict, FixVerdict::kApplied);
}

TEST_F(PoseEstimatorTest, APictureBetweenTwoSamplesIsUsedAtItsOwnTime) {
  // Turning at 1 rad/s: 7 ms of error in time would be 0.4 degrees of heading.
  const Twist2 turn{0, 0, 1};
  for (int i = 0; i < 50; ++i) dut_.Move(Step(i, turn));
  const double before = dut_.newest()->pose.yaw;
  const Time exposure = At(20) + milliseconds(7);
  const FixResult result = dut_.Apply(Fix(exposure, {1, 0.5, 0.407}));
  EXPECT_EQ(result.at_picture.time, exposure);
  EXPECT_NEAR(result.change.yaw, 0, 1e-6);
  EXPECT_NEAR(dut_.newest()->pose.yaw, before, 1e-6);
}

TEST_F(PoseEstimatorTest, AStepThatAPictureCutsHasTheSameNoiseInAll) {
  PoseEstimator in_parts{Config()};
  const OdometryStep whole = Step(0);
  OdometryStep first = whole, second = whole;
  first.to = second.from = kStart + milliseconds(5);
  first.noise *= 0.25;
  second.noise *= 0.75;
  dut_.Move(whole);
  in_parts.Move(first);
  in_parts.Move(second);
  const LandmarkFix fix = Fix(first.to, {1, 0.5, 0});
  EXPECT_EQ(dut_.Apply(fix).verdict, FixVerdict::kApplied);
  EXPECT_EQ(in_parts.Apply(fix).verdict, FixVerdict::kApplied);
  ExpectSame(*dut_.newest(), *in_parts.newest());
}

TEST_F(PoseEstimatorTest, TheChangeIsThatAtTheTimeOfThePicture) {
  Drive(dut_, 0, 100);
  const Pose2 truth{1.45, 0.65, 0.12};
  LandmarkFix fix = Fix(At(50), truth);
  fix.covariance *= 1e-4;
  const FixResult result = dut_.Apply(fix);
  EXPECT_NEAR(result.at_picture.pose.x, truth.x, 2e-3);
  EXPECT_NEAR(result.at_picture.pose.y, truth.y, 2e-3);
  Pose2 believed{1, 0.5, 0};
  for (int i = 0; i < 50; ++i) believed = Integrate(believed, Step(i).twist, 0.02);
  EXPECT_NEAR(result.change.x, truth.x - believed.x, 2e-3);
}

TEST_F(PoseEstimatorTest, AFixThatContradictsTheEstimateIsRefusedAndSaysWhy) {
  Drive(dut_, 0, 50);
  const PoseEstimate before = *dut_.newest();
  const FixResult result = dut_.Apply(Fix(At(30), {2.5, 0.6, 0.05}));
  EXPECT_EQ(result.verdict, FixVerdict::kImplausible);
  EXPECT_GT(result.distance, 4);
  EXPECT_THAT(result.reason, HasSubstr("distance"));
  ExpectSame(*dut_.newest(), before);
}

TEST_F(PoseEstimatorTest, AnErrorAtTheBoundsOfTheStartIsAccepted) {
  Drive(dut_, 0, 5);
  EXPECT_EQ(dut_.Apply(Fix(At(0), {1.2, 0.3, Radians(5)})).verdict, FixVerdict::kApplied);
}

TEST_F(PoseEstimatorTest, APictureOlderThanTheHistoryIsRefused) {
  Drive(dut_, 0, 600);
  const FixResult result = dut_.Apply(Fix(At(50), {1.4, 0.6, 0.1}));
  EXPECT_EQ(result.verdict, FixVerdict::kTooOld);
  EXPECT_THAT(result.reason, HasSubstr("11.0 s old"));
}

TEST_F(PoseEstimatorTest, APictureNewerThanTheOdometryMustWait) {
  Drive(dut_, 0, 50);
  const LandmarkFix fix = Fix(At(51), {1.4, 0.6, 0.1});
  EXPECT_EQ(dut_.Apply(fix).verdict, FixVerdict::kTooNew);
  Drive(dut_, 50, 51);
  EXPECT_EQ(dut_.Apply(fix).verdict, FixVerdict::kApplied);
}

TEST_F(PoseEstimatorTest, TheSameFixCountsOnce) {
  Drive(dut_, 0, 50);
  const LandmarkFix fix = Fix(At(30), {1.3, 0.6, 0.06});
  dut_.Apply(fix);
  const PoseEstimate once = *dut_.newest();
  EXPECT_EQ(dut_.Apply(fix).verdict, FixVerdict::kDouble);
  ExpectSame(*dut_.newest(), once);
}

TEST_F(PoseEstimatorTest, AFixThatIsNotANumberIsRefused) {
  Drive(dut_, 0, 50);
  LandmarkFix fix = Fix(At(30), {1.3, 0.6, 0.06});
  fix.base_from_landmark.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(dut_.Apply(fix).verdict, FixVerdict::kImplausible);
  EXPECT_TRUE(dut_.newest()->covariance.allFinite());
}

TEST_F(PoseEstimatorTest, ACovarianceThatCanBeNoneIsRefused) {
  Drive(dut_, 0, 50);
  const LandmarkFix fix = Fix(At(30), {1.3, 0.6, 0.06});
  LandmarkFix indefinite = fix;
  indefinite.covariance(0, 1) = indefinite.covariance(1, 0) = 0.1;
  EXPECT_EQ(dut_.Apply(indefinite).verdict, FixVerdict::kImplausible);
  for (const double share : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    LandmarkFix odd = fix;
    odd.own_share = share;
    EXPECT_EQ(dut_.Apply(odd).verdict, FixVerdict::kImplausible) << share;
  }
  EXPECT_EQ(dut_.Apply(fix).verdict, FixVerdict::kApplied);
}

TEST_F(PoseEstimatorTest, AFixThatClaimsToBeExactIsNotBelievedToBe) {
  Drive(dut_, 0, 50);
  LandmarkFix fix = Fix(At(50), {1.4, 0.62, 0.1});
  fix.covariance.setZero();
  EXPECT_EQ(dut_.Apply(fix).verdict, FixVerdict::kApplied);
  EXPECT_GE(dut_.newest()->YawSigma(), 0.9 * Radians(Config().least_fix_sigma_deg));
}

TEST_F(PoseEstimatorTest, AfterATimeThatStepsBackTheStateIsKeptAndTheHistoryBeginsAnew) {
  Drive(dut_, 0, 100);
  const Pose2 before = dut_.newest()->pose;
  dut_.Move({.from = At(10), .to = At(10), .noise = Eigen::Matrix3d::Identity() * 0.01, .known = false});
  EXPECT_EQ(dut_.newest()->time, At(10));
  EXPECT_EQ(dut_.newest()->pose.x, before.x);
  EXPECT_GT(dut_.newest()->PositionSigma(), 0.1);
  EXPECT_EQ(dut_.Apply(Fix(At(5), before)).verdict, FixVerdict::kTooOld);
}

TEST_F(PoseEstimatorTest, DrivingWithoutFixesWidensTheEstimateAndAFixNarrowsIt) {
  Drive(dut_, 0, 10);
  const double early = dut_.newest()->PositionSigma();
  Drive(dut_, 10, 400);
  EXPECT_GT(dut_.newest()->PositionSigma(), early);
  const Pose2 here = dut_.newest()->pose;
  dut_.Apply(Fix(dut_.newest()->time, here));
  EXPECT_LT(dut_.newest()->PositionSigma(), 0.03);
}

/// A wall to the left, y = 3 of the map, and what a sensor abeam hears of it.
TEST_F(PoseEstimatorTest, APoseThatSomebodyKnowsReplacesTheEstimate) {
  Drive(dut_, 0, 50);
  const Pose2 before = dut_.newest()->pose;
  const Pose2 change = dut_.Reset({{4, -2, 1.5}, 0.2, 0.1});
  EXPECT_NEAR(change.x, 4 - before.x, 1e-12);
  const PoseEstimate estimate = *dut_.newest();
  EXPECT_EQ(estimate.time, At(50));
  EXPECT_NEAR(estimate.pose.y, -2, 1e-12);
  EXPECT_NEAR(estimate.PositionSigma(), 0.2, 1e-12);
  EXPECT_NEAR(estimate.YawSigma(), 0.1, 1e-12);
  Drive(dut_, 50, 100);
  EXPECT_NEAR((dut_.newest()->pose.translation() - Eigen::Vector2d(4, -2)).norm(), 0.4, 0.03);
}

TEST_F(PoseEstimatorTest, FixesOfPicturesFromBeforeThatAreRefused) {
  Drive(dut_, 0, 50);
  dut_.Reset({{4, -2, 1.5}, 0.2, 0.1});
  Drive(dut_, 50, 60);
  EXPECT_EQ(dut_.Apply(Fix(At(45), {1.4, 0.6, 0.1})).verdict, FixVerdict::kTooOld);
  EXPECT_EQ(dut_.Apply(Fix(At(55), {4, -1.96, 1.51})).verdict, FixVerdict::kApplied);
}

TEST_F(PoseEstimatorTest, APoseThatIsKnownBeforeTheFirstStepIsWhereItStarts) {
  dut_.Reset({{4, -2, 1.5}, 0.2, 0.1});
  dut_.Move(Step(0, {}));
  EXPECT_NEAR(dut_.newest()->pose.x, 4, 1e-9);
}

class WallsTest : public PoseEstimatorTest {
 protected:
  static RingHeard Heard(int index, double y_m, bool found = false) {
    const Pose2 sonar{0, 0.39, kPi / 2};
    RingHeard heard{At(index), {{sonar, 3 - y_m - 0.39, 0.01}}, {}};
    if (found) heard.walls.push_back({kPi / 2, 3 - y_m, Eigen::Vector2d(4e-6, 1e-6).asDiagonal()});
    return heard;
  }
  static OdometryStep Ahead(int index) {
    OdometryStep step = Step(index, {0.4, 0, 0});
    step.noise.diagonal() << 1e-6, 1e-6, 1e-5;
    return step;
  }
  /// 4 s along the wall, found after one; ranges at 10 Hz while `hears`.
  static void DriveAlong(PoseEstimator& estimator, bool hears, const LandmarkFix* prompt = nullptr) {
    for (int i = 0; i < 200; ++i) {
      estimator.Move(Ahead(i));
      if (hears && i % 5 == 4) estimator.Hear(Heard(i + 1, 0.5, i == 49));
      if (prompt && prompt->exposure == At(i + 1)) {
        EXPECT_EQ(estimator.Apply(*prompt).verdict, FixVerdict::kApplied);
      }
    }
  }
};

TEST_F(WallsTest, RangesOfAWallHoldTheHeading) {
  PoseEstimator deaf{Config()};
  const LandmarkFix fix = Fix(At(45), {1 + 0.008 * 45, 0.5, 0});
  DriveAlong(dut_, true, &fix);
  DriveAlong(deaf, false, &fix);
  EXPECT_EQ(dut_.walls(), 1);
  EXPECT_EQ(deaf.walls(), 0);
  EXPECT_LT(dut_.newest()->YawSigma(), 0.7 * deaf.newest()->YawSigma());
}

TEST_F(WallsTest, ALateFixGivesTheSameAsOneThatCameAtOnceThoughWallsCameToLightSince) {
  PoseEstimator prompt{Config()};
  const LandmarkFix fix = Fix(At(40), {1.3, 0.55, 0.03});
  DriveAlong(prompt, true, &fix);
  DriveAlong(dut_, true);
  EXPECT_EQ(dut_.Apply(fix).verdict, FixVerdict::kApplied);
  ExpectSame(*dut_.newest(), *prompt.newest());
}

TEST_F(WallsTest, AKnownWallIsNotTakenUpTwiceUnlessItWasNotHeardForLong) {
  DriveAlong(dut_, true);
  dut_.Hear(Heard(200, 0.5, true));
  EXPECT_EQ(dut_.walls(), 1);
  // Nothing for 4 s, then a wall 10 cm nearer.
  for (int i = 200; i < 400; ++i) dut_.Move(Ahead(i));
  dut_.Hear(Heard(400, 0.6, true));
  EXPECT_EQ(dut_.walls(), 1);
}

TEST_F(WallsTest, ARangeThatFitsWhereAWallWasHeardLongAgoIsNotTheWalls) {
  DriveAlong(dut_, true);
  for (int i = 200; i < 400; ++i) dut_.Move(Ahead(i));
  const PoseEstimate before = *dut_.newest();
  dut_.Hear(Heard(400, 0.51));
  ExpectSame(*dut_.newest(), before);
  EXPECT_EQ(dut_.walls(), 0);
}

TEST_F(WallsTest, TheOneNotHeardForLongestGivesWayToANewOne) {
  DriveAlong(dut_, false);
  for (int i = 0; i < 6; ++i) {
    dut_.Move(Ahead(200 + i));
    const double bearing = Radians(30.0 * i);
    dut_.Hear({At(201 + i), {}, {{bearing, 2, Eigen::Matrix2d::Identity() * 1e-6}}});
  }
  EXPECT_EQ(dut_.walls(), PoseState::kMostWalls);
}

TEST_F(WallsTest, CyclesOfThePastAndBeforeTheFirstStepAreIgnored) {
  dut_.Hear(Heard(0, 0.5, true));
  DriveAlong(dut_, true);
  const PoseEstimate before = *dut_.newest();
  dut_.Hear(Heard(100, 0.3, true));
  dut_.Hear({FromUtime(0), {}, {{0, 1, Eigen::Matrix2d::Identity()}}});
  ExpectSame(*dut_.newest(), before);
  EXPECT_EQ(dut_.walls(), 1);
}

/// The factor of the slip after fixes 0.3 m apart that show the heading `off_rad` to one side and the other
/// of where the wheels have it.
double SlipFactorAfter(double off_rad) {
  constexpr double kSpeed_m_s = 0.3, kSlip = 9.4e-5;
  constexpr Duration kStep = std::chrono::milliseconds(20);
  const double kept = std::exp(-kSpeed_m_s * 0.02 / 0.3);
  const Pose2 landmark{6, 0, 0};
  PoseEstimatorConfig config;
  config.initial = {.position_error_m = 0.05, .yaw_error_deg = 3};
  PoseEstimator dut(config);
  Time now = FromUtime(1'000'000);
  for (int fix = 0; fix < 12; ++fix) {
    for (int i = 0; i < 50; ++i, now += kStep)
      dut.Move({.from = now,
                .to = now + kStep,
                .twist = {kSpeed_m_s, 0, 0},
                .wander = {kept, Eigen::Vector3d::Constant(kSlip * (1 - kept * kept))}});
    const Pose2 truth{0.3 * (fix + 1), 0, fix % 2 ? off_rad : -off_rad};
    const Eigen::Matrix3d covariance = Eigen::Vector3d(1e-6, 1e-6, 2.5e-7).asDiagonal();
    EXPECT_EQ(dut.Apply({now, fix, truth.Inverse() * landmark, covariance, landmark}).verdict,
              FixVerdict::kApplied);
  }
  return dut.slip_factor();
}

TEST(PoseEstimator, FixesTellHowMuchTheWheelsSlip) {
  EXPECT_LT(SlipFactorAfter(0.0002), 0.7);
  EXPECT_GT(SlipFactorAfter(0.0025), 2);
}

/// Straight ahead by the wheels; the base turned, 0.5 m after a fix, by `turned_rad` on its way to the next
/// one. What becomes of that one, and the sigma of the heading before it was told.
std::pair<FixResult, double> FixAfterATurn(double turned_rad) {
  constexpr Duration kStep = std::chrono::milliseconds(20);
  const double kept = std::exp(-0.3 * 0.02 / 0.3);
  const Pose2 landmark{6, 0, 0};
  PoseEstimatorConfig config;
  config.initial = {.position_error_m = 0.05, .yaw_error_deg = 3};
  PoseEstimator dut(config);
  Time now = FromUtime(1'000'000);
  const auto drive = [&] {
    for (int i = 0; i < 83; ++i, now += kStep)
      dut.Move({.from = now,
                .to = now + kStep,
                .twist = {0.3, 0, 0},
                .wander = {kept, Eigen::Vector3d::Constant(9.4e-5 * (1 - kept * kept))}});
  };
  const auto look = [&](int id, const Pose2& truth) {
    const Eigen::Matrix3d covariance = Eigen::Vector3d(1e-5, 1e-5, 1e-6).asDiagonal();
    return dut.Apply({now, id, truth.Inverse() * landmark, covariance, landmark});
  };
  drive();
  EXPECT_EQ(look(1, {0.498, 0, 0}).verdict, FixVerdict::kApplied);
  drive();
  const double sigma = dut.newest()->YawSigma();
  return {look(2, {0.996, turned_rad * 0.25, turned_rad}), sigma};
}

TEST(PoseEstimator, AFixThatOnlyWheelsWhichSlipMoreExplainIsJudgedByThem) {
  const auto [near, sigma] = FixAfterATurn(0);
  EXPECT_LT(near.distance, 1);
  const auto [slipped, same] = FixAfterATurn(5 * sigma);
  EXPECT_EQ(slipped.verdict, FixVerdict::kApplied) << slipped.reason;
  EXPECT_LT(slipped.distance, 4);
}

TEST(PoseEstimator, AFixThatIsFarOffIsRefusedAtOnce) {
  const auto [near, sigma] = FixAfterATurn(0);
  const auto [far, same] = FixAfterATurn(12 * sigma);
  EXPECT_EQ(far.verdict, FixVerdict::kImplausible);
  EXPECT_GT(far.distance, 8);
}

}  // namespace
}  // namespace priamos::robot
