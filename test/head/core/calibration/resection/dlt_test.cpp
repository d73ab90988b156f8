#include "head/core/calibration/resection/dlt.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "test/support/calibration_scene.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

/// The discs' centres as a camera sees them, with noise.
std::vector<PointPair> Pairs(const CameraModel& camera, double noise_px, Rng& rng) {
  std::vector<PointPair> pairs;
  for (const ReferenceDisc& disc : support::ShippedReferenceObject().discs) {
    const Eigen::Vector2d noise(rng.Normal(noise_px), rng.Normal(noise_px));
    pairs.push_back({disc.centre_m, camera.Project(disc.centre_m) + noise});
  }
  return pairs;
}

class Dlt : public testing::Test {
 protected:
  Rng rng{4};
  CameraModel camera = support::MakeCamera({});
  std::vector<PointPair> pairs = Pairs(camera, 0, rng);
};

TEST_F(Dlt, RecoversTheMatrixFromPerfectPoints) {
  const auto dut = SolveDlt(pairs);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT((*dut - camera.image_from_base).norm() / camera.image_from_base.norm(), 1e-8);
}

TEST_F(Dlt, SixPointsAreEnough) {
  const auto dut = SolveDlt(std::span(pairs).first(6));
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(MeanImageError(*dut, pairs), 1e-6);
}

TEST_F(Dlt, LeastSquaresSpreadsTheNoise) {
  pairs = Pairs(camera, 0.1, rng);
  const auto dut = SolveDlt(pairs);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(MeanImageError(*dut, pairs), 0.15);
  EXPECT_LT(MeanImageError(*dut, Pairs(camera, 0, rng)), 0.12);
}

TEST_F(Dlt, ManyRandomProblemsAreAllSolved) {
  for (int i = 0; i < 1000; ++i) {
    const CameraModel any = support::MakeCamera(support::RandomView(rng));
    const double noise = rng.Uniform(0.1, 1);
    std::vector<PointPair> random;
    const std::size_t n = 6 + rng.Below(11);
    while (random.size() < n) {
      const Eigen::Vector3d x(rng.Uniform(-0.25, 0.25), rng.Uniform(-0.3, 0.3), rng.Uniform(-0.3, 0.3));
      random.push_back({x, any.Project(x) + Eigen::Vector2d(rng.Normal(noise), rng.Normal(noise))});
    }
    const auto dut = SolveDlt(random);
    ASSERT_TRUE(dut) << dut.reason();
    EXPECT_LT(MeanImageError(*dut, random), 3 * noise);
  }
}

TEST_F(Dlt, RefusesTooFewPoints) {
  EXPECT_THAT(SolveDlt(std::span(pairs).first(5)).reason(), HasSubstr("at least 6 points, got 5"));
}

TEST_F(Dlt, RefusesNumbersThatAreNone) {
  pairs[3].image_px.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(SolveDlt(pairs).reason(), HasSubstr("point 3"));
}

TEST_F(Dlt, RefusesCoplanarPointsEvenWithNoise) {
  for (PointPair& p : pairs) {
    p.point_m.x() = 0.1 + 0.3 * p.point_m.y();
    p.image_px = camera.Project(p.point_m) + Eigen::Vector2d(rng.Normal(0.5), rng.Normal(0.5));
  }
  EXPECT_THAT(SolveDlt(pairs).reason(), HasSubstr("one plane"));
}

TEST_F(Dlt, RefusesPointsOnALineAndInOnePlace) {
  for (PointPair& p : pairs) p.point_m = {0.1, p.point_m.y(), 2 * p.point_m.y()};
  EXPECT_THAT(SolveDlt(pairs).reason(), HasSubstr("one line"));
  for (PointPair& p : pairs) p.point_m = {0.1, 0.2, 0.3};
  EXPECT_THAT(SolveDlt(pairs).reason(), HasSubstr("coincide"));
}

TEST_F(Dlt, RefusesTheTwistedCubicThroughTheCamera) {
  // Points on a twisted cubic that also passes through the optical centre: the classical critical curve.
  const Eigen::Vector3d eye = support::EyeOf(camera);
  std::vector<PointPair> cubic;
  for (int i = 1; i <= 12; ++i) {
    const double t = 0.05 * i + 0.3;
    const Eigen::Vector3d x = eye + Eigen::Vector3d(-2 * t, 0.5 * t * t, 0.4 * t * t * t);
    cubic.push_back({x, camera.Project(x)});
  }
  EXPECT_THAT(SolveDlt(cubic).reason(), HasSubstr("degenerate"));
}

TEST_F(Dlt, NoticesSwappedColumns) {
  std::vector<PointPair> swapped = pairs;
  for (PointPair& p : swapped) std::swap(p.image_px.x(), p.image_px.y());
  EXPECT_THAT(SolveDlt(swapped).reason(), HasSubstr("swapped"));
  swapped = pairs;
  for (PointPair& p : swapped) std::swap(p.point_m.y(), p.point_m.z());
  EXPECT_THAT(SolveDlt(swapped).reason(), HasSubstr("swapped"));
}

}  // namespace
}  // namespace priamos::head
