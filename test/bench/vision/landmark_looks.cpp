#include "test/bench/vision/landmark_looks.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "common/config.hpp"
#include "head/core/motion/aim.hpp"
#include "head/core/motion/aim_tilt.hpp"
#include "head/core/motion/lens_choice.hpp"
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

/// The base in the landmark's frame, such that head::Predict gives what is believed.
head::PoseSample StandingAt(const LandmarkLook& look) {
  head::PoseSample robot;
  robot.map_from_base = look.believed.Inverse();
  Eigen::Matrix3d j = Eigen::Matrix3d::Zero();
  j.topLeftCorner<2, 2>() = -robot.map_from_base.rotation().transpose();
  j.col(2) = Eigen::Vector3d(look.believed.y, -look.believed.x, -1);
  robot.covariance = j.inverse() * look.belief * j.inverse().transpose();
  return robot;
}

/// Setting of the head for a look, with the shipped configuration of the simulated head. A base that chooses
/// its lens stands, its motors at the setting of all looks.
head::HeadSetting LookAt(const head::HeadModel& head, head::LandmarkModel model, const LandmarkLook& look,
                         int side, bool choose_lens) {
  static const auto kConfig = LoadConfig<head::HeadConfig>(InSim("head.toml"));
  head::HeadSetting setting = kConfig.LookSetting();
  setting.tilt_rad = head::AimTilt(head, setting, model, look.believed, kConfig.look_up);
  if (choose_lens) {
    model.map_from_landmark = {};
    const head::PoseSample robot = StandingAt(look);
    setting = head::ChooseLens(head, setting, setting, {model, robot, side}, kConfig.aim, kConfig.lens,
                               kConfig.motors.approach_steps);
  } else {
    setting.pan_rad = head::AimPan(head, setting, model, {look.believed, look.belief}, side, kConfig.aim);
  }
  setting.pan_rad = std::round(setting.pan_rad / 0.0001) * 0.0001;  // whole steps
  return setting;
}

/// What is believed is nominal; the truth lies around it.
void DrawPoses(double distance_m, double doubt, Rng& rng, LandmarkLook& look) {
  const Pose2 believed{-distance_m, 0, 0};
  const double radius = doubt * 0.2 * std::sqrt(rng.Uniform(0, 1)), bearing = rng.Uniform(-kPi, kPi);
  const Pose2 truth{believed.x + radius * std::cos(bearing), radius * std::sin(bearing),
                    Radians(doubt * rng.Uniform(-5, 5))};
  look.believed = believed.Inverse();
  look.truth = truth.Inverse();
  look.belief = doubt * doubt * LookBelief();
}

std::string NameOf(int side, int visit) {
  return visit > 0 ? fmt::format("{} {}", side, visit) : fmt::format("{}", side);
}

}  // namespace

Eigen::Matrix3d LookBelief() {
  return Eigen::Vector3d(0.115 * 0.115, 0.115 * 0.115, 0.05 * 0.05).asDiagonal();
}

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
  DrawPoses(distance_m + head.build.x_m, stage.doubt, rng, look);

  const head::HeadSetting setting = look.setting =
      LookAt(head.model, look.exact_model, look, side, stage.choose_lens);
  world::RendererConfig config;
  config.imaging.focus_by_distance = stage.focus_by_distance;
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
  const auto expose = [&](int camera) {
    const GreyImage image =
        renderer.Expose(static_cast<world::Camera>(camera), opening, closing, exposure, noise);
    return cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()))
        .clone();
  };
  for (int c = 0; c < 2; ++c) {
    look.images[c] = expose(c);
    look.calibrated[c] = *head.model.CameraAt(setting, c);
    look.exact[c] = ExactCamera(head.build, c, axes);
  }
  if (const auto third = head.model.CameraAt(setting, head::kThird)) {
    look.third = expose(head::kThird);
    look.third_calibrated = *third;
  }
  return look;
}

}  // namespace priamos::bench
