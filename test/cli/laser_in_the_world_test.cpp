#include <gtest/gtest.h>

#include <cmath>

#include "head/core/calibration/rig/laser_calibration.hpp"
#include "test/support/image_from_base.hpp"
#include "world/core/render/renderer.hpp"

// The simulated laser and its calibration share no code: do they mean the same plane?

namespace priamos {
namespace {

using Eigen::Vector3d;

/// The floor alone or, higher, the top of a box before the robot.
std::vector<world::Solid> Box(double height_m) {
  if (height_m == 0) return {};
  return {{"box", {2.0, 0, 0}, {1.2, 1.6}, 0, height_m, "door_frame"}};
}

TEST(LaserInTheWorld, EachIsCalibratedToWhereItIs) {
  world::RendererConfig config;
  config.scene.x_min_m = -1;
  config.scene.x_max_m = 8;
  config.scene.y_min_m = -3;
  config.scene.y_max_m = 3;
  config.head = world::HeadBuild::Specimen(5);
  world::Viewpoint at;
  at.head.tilt_rad = 0.54;
  const world::TrueCamera camera = world::CameraAt(config.head, world::kThirdCamera, at.head);
  const head::CameraModel model{world::ImageFromBase(camera), camera.centre_px, camera.focal_px, camera.k1,
                                camera.k2};
  world::Renderer renderer(config, {}, 1);
  Rng rng(2);
  std::vector<std::vector<head::StripeView>> views(config.lasers.size());
  for (const double height : {0.0, 0.15}) {
    renderer.SetScene(config, Box(height), 1);
    const GreyImage image = renderer.Expose(world::kThirdCamera, at, at, {0.004, 1, 0, 3}, rng);
    auto lines = head::StripeFinder().FindInOrder(image, 2);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_GT(lines[k].size(), 300u) << height;
      // The lowest line is that of the first laser.
      views[1 - k].push_back({model, {Vector3d::UnitZ(), Vector3d(0, 0, height)}, std::move(lines[k])});
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const auto dut = head::CalibrateLaserPlane(views[k]);
    ASSERT_TRUE(dut) << dut.reason();
    EXPECT_LT(dut->rms_px, 0.3);
    const auto truth = config.lasers[k].Plane();
    for (const double x : {1.7, 2.1}) {
      for (const double y : {-0.4, 0.0, 0.4}) {
        const Vector3d in_light = truth.projection(Vector3d(x + 0.9 * static_cast<double>(k), y, 0.1));
        EXPECT_NEAR(dut->plane.Plane().signedDistance(in_light), 0, 0.001) << k << " " << x << " " << y;
      }
    }
  }
}

}  // namespace
}  // namespace priamos
