#include "head/core/tracks/tracked_place.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

const PlaceOptions kOptions{0.01, 0, 4};

TrackedPlace At(double x_m, double sigma_m, const Pose2& map_from_base = {}) {
  return PlaceOf(map_from_base.Inverse() * Pose2{x_m, 0, 0.1},
                 sigma_m * sigma_m * Eigen::Matrix2d::Identity(), map_from_base, kOptions);
}

TEST(TrackedPlace, CovariancesAreTurnedIntoTheMap) {
  Eigen::Matrix2d covariance;
  covariance << 4e-4, 0, 0, 1e-4;
  const TrackedPlace place = PlaceOf({1, 0, 0}, covariance, {2, 3, kPi / 2}, kOptions);
  EXPECT_NEAR(place.map_from_thing.x, 2, 1e-12);
  EXPECT_NEAR(place.map_from_thing.y, 4, 1e-12);
  EXPECT_NEAR(place.covariance(1, 1), 4e-4, 1e-12);
  EXPECT_NEAR(place.covariance(0, 0), 1e-4, 1e-12);
}

TEST(TrackedPlace, TheBetterKnownOneWeighsMore) {
  TrackedPlace place = At(2, 0.02);
  const double share = Fuse(At(2.03, 0.01), kOptions, place);
  EXPECT_NEAR(share, 2.0 / 3, 1e-9);
  EXPECT_NEAR(place.map_from_thing.x, 2 + 0.03 * 0.8, 1e-9);
}

TEST(TrackedPlace, ManyLooksAreNeverBetterThanHalfOfTheBest) {
  TrackedPlace place = At(2, 0.02);
  for (int i = 0; i < 100; ++i) Fuse(At(2, 0.02), kOptions, place);
  EXPECT_NEAR(SigmaOf(place.covariance), SigmaOf(At(2, 0.02).covariance) / 2, 1e-6);
}

TEST(TrackedPlace, WhatContradictsAllBeforeTakesTheirPlace) {
  TrackedPlace place = At(2, 0.02);
  EXPECT_EQ(Fuse(At(2.4, 0.02), kOptions, place), 1);
  EXPECT_NEAR(place.map_from_thing.x, 2.4, 1e-9);
}

TEST(TrackedPlace, WhatWasSeenMovesWithTheCorrectedPose) {
  TrackedPlace place = At(2, 0.02, {1, 0, 0});
  const Pose2 correction{0.1, 0.2, Radians(3)};
  const Pose2 seen = place.map_from_base.Inverse() * place.map_from_thing;
  Move(correction, place);
  const Pose2 now = place.map_from_base.Inverse() * place.map_from_thing;
  EXPECT_NEAR((seen.translation() - now.translation()).norm(), 0, 1e-12);
  EXPECT_NEAR(place.map_from_thing.yaw, 0.1 + Radians(3), 1e-12);
}

TEST(TrackedPlace, ALongWayBetweenLooksMakesTheFirstOneLessCertain) {
  TrackedPlace place = At(2, 0.01);
  Fuse(At(2.03, 0.01, {-10, 0, 0}), kOptions, place);
  EXPECT_GT(place.map_from_thing.x, 2.028) << "10 cm of drift on the way";
}

}  // namespace
}  // namespace priamos::head
