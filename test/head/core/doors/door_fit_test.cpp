#include "head/core/doors/door_fit.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>

#include "common/random.hpp"
#include "test/head/exact_view.hpp"
#include "test/support/generated_numbers.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using support::Between;
using test::ExactView;

constexpr double kSigma_px = 0.3;
const DoorShape kDoor{{3.2, 0.45}, {3.3, -0.45}, 2.0};

Vector3d Up(const Vector2d& foot, double z) {
  return {foot.x(), foot.y(), z};
}

/// The unknowns in the order of DoorFit::covariance.
Eigen::Matrix<double, 5, 1> Unknowns(const DoorShape& door) {
  Eigen::Matrix<double, 5, 1> x;
  x << door.left, door.right, door.height_m;
  return x;
}

/// Two pictures of the three edges of a door: in each of them the lines are left, right, lintel.
class DoorPictures {
 public:
  /// `line_sigma_px` is what the lines themselves are known to.
  explicit DoorPictures(const DoorShape& door, double line_sigma_px = 0)
      : door_(door),
        left_(test::HeadCamera(0, 1), line_sigma_px),
        right_(test::HeadCamera(0, -1), line_sigma_px) {}

  /// Draws all lines, beside their places by `noise_px` across them: an upright as a whole, a lintel at
  /// either end.
  void Draw(double noise_px, Rng& rng) {
    for (ExactView* picture : {&left_, &right_}) {
      const auto project = [&](const Vector3d& at) { return picture->camera().Project(at); };
      for (const Vector2d& foot : {door_.left, door_.right}) {
        const Vector2d aside(rng.Normal(noise_px), 0);
        picture->Draw(project(Up(foot, 0.5)) + aside, project(Up(foot, 1.9)) + aside, 80, 140, 0);
      }
      const Vector2d first(0, rng.Normal(noise_px)), second(0, rng.Normal(noise_px));
      picture->Draw(project(Up(door_.left, door_.height_m)) + first,
                    project(Up(door_.right, door_.height_m)) + second, 80, 140, 0);
    }
  }
  std::optional<DoorFit> Fit(const DoorShape& start, const DoorLines& lines, double sigma_px = kSigma_px) {
    const CameraView left = left_.View(), right = right_.View();
    return FitDoor({&left, &right}, lines, start, sigma_px);
  }

 private:
  DoorShape door_;
  ExactView left_, right_;
};

const DoorLines kAllLines{{{{0, 1}, {0, 1}}}, {2, 2}};

class DoorFitTest : public testing::Test {
 protected:
  DoorFitTest() { pictures_.Draw(0, rng_); }
  Rng rng_{1};
  DoorPictures pictures_{kDoor};
};

TEST_F(DoorFitTest, ADoorThatAllLinesAgreeOnIsFoundExactly) {
  const auto dut = pictures_.Fit(kDoor, kAllLines);
  ASSERT_TRUE(dut);
  EXPECT_LT((Unknowns(dut->shape) - Unknowns(kDoor)).norm(), 1e-6);
  EXPECT_LT(dut->chi2, 1e-9);
  EXPECT_EQ(dut->freedom, 3) << "four uprights and four ends of lintels for five unknowns";
}

RC_GTEST_FIXTURE_PROP(DoorFitTest, TheStartMayBeWrong, ()) {
  const DoorShape start{kDoor.left + Vector2d(Between(-0.2, 0.2), Between(-0.05, 0.05)),
                        kDoor.right + Vector2d(Between(-0.2, 0.2), Between(-0.05, 0.05)),
                        kDoor.height_m + Between(-0.1, 0.1)};
  const auto dut = pictures_.Fit(start, kAllLines);
  RC_ASSERT(dut.has_value());
  RC_ASSERT((Unknowns(dut->shape) - Unknowns(kDoor)).norm() < 1e-3);
}

TEST_F(DoorFitTest, AFitThatLeadsFarAwayIsNone) {
  DoorShape start = kDoor;
  start.left.x() -= 0.35;
  start.right.x() -= 0.35;
  EXPECT_TRUE(pictures_.Fit(start, kAllLines));
  start.left.x() -= 0.15;
  start.right.x() -= 0.15;
  EXPECT_FALSE(pictures_.Fit(start, kAllLines)) << "half a metre is another door";
}

TEST_F(DoorFitTest, AnUprightThatOneCameraDoesNotSeeFollowsFromTheLintel) {
  DoorLines lines = kAllLines;
  lines.uprights[1][1] = -1;
  const auto dut = pictures_.Fit(kDoor, lines);
  ASSERT_TRUE(dut);
  EXPECT_LT((Unknowns(dut->shape) - Unknowns(kDoor)).norm(), 1e-4);
  EXPECT_EQ(dut->freedom, 2);
  const auto all = pictures_.Fit(kDoor, kAllLines);
  EXPECT_GT(dut->covariance(2, 2), all->covariance(2, 2));
}

TEST_F(DoorFitTest, TooFewLinesAreNoDoor) {
  EXPECT_FALSE(pictures_.Fit(kDoor, {}));
  EXPECT_FALSE(pictures_.Fit(kDoor, {{{{0, 1}, {0, 1}}}, {-1, -1}})) << "without a lintel no height";
  EXPECT_FALSE(pictures_.Fit(kDoor, {{{{0, 1}, {-1, -1}}}, {2, -1}})) << "one camera measures no distance";
  EXPECT_TRUE(pictures_.Fit(kDoor, {{{{0, 1}, {0, 1}}}, {2, -1}}));
}

TEST_F(DoorFitTest, ANeverSeenUprightIsNotDetermined) {
  EXPECT_FALSE(pictures_.Fit(kDoor, {{{{0, -1}, {0, -1}}}, {2, 2}}));
}

TEST_F(DoorFitTest, TheCovarianceGrowsWithTheSquareOfTheSigma) {
  const auto one = pictures_.Fit(kDoor, kAllLines, 0.2), two = pictures_.Fit(kDoor, kAllLines, 0.4);
  ASSERT_TRUE(one && two);
  EXPECT_LT((two->covariance - 4 * one->covariance).norm(), 1e-3 * two->covariance.norm());
  EXPECT_LT((one->covariance - one->covariance.transpose()).norm(), 1e-9);
  for (const int x : {0, 2})
    EXPECT_GT(one->covariance(x, x), one->covariance(x + 1, x + 1)) << "depth is worse";
}

TEST_F(DoorFitTest, TheNoiseOfTheLinesCountsAsWell) {
  DoorPictures vague(kDoor, 0.4);
  vague.Draw(0, rng_);
  const auto exact = pictures_.Fit(kDoor, kAllLines, 0.3), dut = vague.Fit(kDoor, kAllLines, 0.3);
  ASSERT_TRUE(exact && dut);
  // 0.5 px for the uprights. At the ends of the lintel the angle's error adds: sqrt(3) times that across it.
  const double least = (0.16 + 0.09) / 0.09, most = (4 * 0.16 + 0.09) / 0.09;
  for (int i = 0; i < 5; ++i) {
    EXPECT_GT(dut->covariance(i, i), 0.99 * least * exact->covariance(i, i)) << i;
    EXPECT_LT(dut->covariance(i, i), 1.01 * most * exact->covariance(i, i)) << i;
  }
}

TEST(DoorFitStatisticsTest, ErrorsAreWhatCovarianceAndMisfitSay) {
  Rng rng(2);
  constexpr int kRuns = 200;
  double nees = 0, chi2 = 0;
  for (int run = 0; run < kRuns; ++run) {
    DoorPictures pictures(kDoor);
    pictures.Draw(kSigma_px, rng);
    const auto dut = pictures.Fit(kDoor, kAllLines);
    ASSERT_TRUE(dut);
    const auto error = (Unknowns(dut->shape) - Unknowns(kDoor)).eval();
    nees += error.dot(dut->covariance.inverse() * error) / kRuns;
    chi2 += dut->chi2 / kRuns;
  }
  // Means of chi squared with 5 and 3 degrees of freedom, within 4 sigma of 200 draws.
  EXPECT_NEAR(nees, 5, 4 * std::sqrt(10.0 / kRuns));
  EXPECT_NEAR(chi2, 3, 4 * std::sqrt(6.0 / kRuns));
}

}  // namespace
}  // namespace priamos::head
