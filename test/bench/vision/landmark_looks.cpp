#include "test/bench/vision/landmark_looks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/config.hpp"
#include "head/core/motion/aim.hpp"
#include "head/head_config.hpp"
#include "test/bench/vision/true_axes.hpp"

namespace priamos::bench {
namespace {

/// Every edge shifted and tilted across itself.
head::LandmarkModel Tolerated(head::LandmarkModel model, const LookTolerances& t, Rng& rng) {
  for (head::LandmarkEdge& e : model.edges) {
    const Eigen::Vector3d along = (e.to - e.from).normalized(), a = along.unitOrthogonal(),
                          b = along.cross(a);
    const Eigen::Vector3d shift = rng.Normal(t.model_sigma_m) * a + rng.Normal(t.model_sigma_m) * b;
    const Eigen::Vector3d tilt = rng.Normal(t.tilt_sigma_m) * a + rng.Normal(t.tilt_sigma_m) * b;
    e.from += shift - tilt;
    e.to += shift + tilt;
  }
  return model;
}

/// Setting of the head for a look, with the shipped configuration of the simulated head.
head::HeadSetting LookAt(const head::HeadModel& head, const head::LandmarkModel& model, const Pose2& believed,
                         int side) {
  static const auto kConfig = LoadConfig<head::HeadConfig>(InSim("head.toml"));
  head::HeadSetting setting = kConfig.LookSetting();
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.115 * 0.115, 0.115 * 0.115, 0.05 * 0.05).asDiagonal();
  setting.pan_rad = head::AimPan(head, setting, model, {believed, covariance}, side, kConfig.aim);
  setting.pan_rad = std::round(setting.pan_rad / 0.0001) * 0.0001;  // whole steps
  return setting;
}

/// What is believed is nominal; the truth lies around it.
void DrawPoses(double distance_m, Rng& rng, LandmarkLook& look) {
  const Pose2 believed{-distance_m, 0, 0};
  const double radius = 0.2 * std::sqrt(rng.Uniform(0, 1)), bearing = rng.Uniform(-kPi, kPi);
  const Pose2 truth{believed.x + radius * std::cos(bearing), radius * std::sin(bearing),
                    Radians(rng.Uniform(-5, 5))};
  look.believed = believed.Inverse();
  look.truth = truth.Inverse();
}

std::string NameOf(int side, int visit) {
  return visit > 0 ? fmt::format("{} {}", side, visit) : fmt::format("{}", side);
}

}  // namespace

std::string InSim(const std::string& name) {
  return PRIAMOS_SOURCE_DIR "/config/sim/" + name;
}

head::LandmarkModel ToHead(const planner::Landmark& landmark) {
  head::LandmarkModel model{landmark.id, landmark.map_from_landmark, {}};
  for (const planner::LandmarkEdge& e : landmark.edges)
    model.edges.push_back(
        {e.from, e.to, e.visible_from_rad, e.visible_to_rad, static_cast<int>(e.side), e.grey_ratio});
  return model;
}

LandmarkLook TakeLook(const LookStage& stage, const CalibratedHead& head, const LookTolerances& tolerances,
                      int side, std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "look");
  LandmarkLook look;
  look.exact_model = ToHead(stage.landmark);
  look.model = Tolerated(look.exact_model, tolerances, rng);
  look.base_covariance = head.model.base_covariance;
  if (stage.visit > 0) rng = Rng::Stream(seed, fmt::format("visit {}", stage.visit));
  const double distance_m = stage.visit > 0 ? rng.Uniform(1.8, 3.2) : stage.distance_m;
  DrawPoses(distance_m + head.build.x_m, rng, look);

  const head::HeadSetting setting = look.setting = LookAt(head.model, look.exact_model, look.believed, side);
  world::RendererConfig config;
  config.scene = stage.light;
  config.head = head.build;
  world::Renderer renderer(config, world::BuildSolids(stage.map, stage.plan, seed), seed);
  Rng motors = Rng::Stream(seed, "motors " + NameOf(side, stage.visit));
  const world::HeadAxes axes = RestAfter(setting, motors);
  const Pose2 map_from_base = stage.landmark.map_from_landmark * look.truth.Inverse();
  const world::Exposure exposure{0.008, 1, 0, 0};
  const Twist2 twist{rng.Uniform(0, 0.3), 0, rng.Uniform(-0.05, 0.05)};
  const world::Viewpoint opening{Integrate(map_from_base, twist, -exposure.exposure_s / 2), axes},
      closing{Integrate(map_from_base, twist, exposure.exposure_s / 2), axes};
  Rng noise = Rng::Stream(seed, "noise " + NameOf(side, stage.visit));
  for (int c = 0; c < 2; ++c) {
    const GreyImage image = renderer.Expose(static_cast<world::Camera>(c), opening, closing, exposure, noise);
    look.images[c] =
        cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())).clone();
    look.calibrated[c] = *head.model.CameraAt(setting, c);
    look.exact[c] = ExactCamera(head.build, c, axes);
  }
  return look;
}

}  // namespace priamos::bench
