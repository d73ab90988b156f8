#include "head/core/scene/missing_border.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

const Eigen::Vector3d kFrom(2.5, 0.4, 0.8), kTo(2.5, -0.4, 0.8);

TEST(MissingBorder, WhatIsInThePictureAndNotSeenIsMissing) {
  EXPECT_TRUE(IsMissing(kFrom, kTo, test::HeadCamera(0, 1), {}));
}

TEST(MissingBorder, APieceOfItIsEnough) {
  const CameraModel camera = test::HeadCamera(0, 1);
  const Eigen::Vector2d p = camera.Project(kFrom), q = camera.Project(kTo);
  EXPECT_FALSE(IsMissing(kFrom, kTo, camera, std::array{ImageLine{p, p + 0.4 * (q - p)}}));
  EXPECT_TRUE(IsMissing(kFrom, kTo, camera, std::array{ImageLine{p, p + 0.1 * (q - p)}}));
  EXPECT_TRUE(IsMissing(kFrom, kTo, camera, std::array{ImageLine{p, p + Eigen::Vector2d(0, 200)}}))
      << "another edge that crosses it";
}

TEST(MissingBorder, WhatIsBesideThePictureTellsNothing) {
  EXPECT_FALSE(IsMissing({0.6, 0.4, 0.5}, {0.6, -0.4, 0.5}, test::HeadCamera(0, 1), {}));
}

}  // namespace
}  // namespace priamos::head
