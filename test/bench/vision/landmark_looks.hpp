#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "head/core/camera/head_model.hpp"
#include "head/core/landmark/landmark.hpp"
#include "planner/core/map/landmark.hpp"
#include "world/core/render/renderer.hpp"
#include "world/world_loading.hpp"

namespace priamos::bench {

/// A specimen of KASTOR, and what its own calibration made of it: the reference object stood a little wrong,
/// motors and disc centres had their noise.
struct CalibratedHead {
  world::HeadBuild build;
  head::HeadModel model;
  Eigen::Isometry3d misplacement = Eigen::Isometry3d::Identity();  ///< from where the object should stand
};

/// Calibrates specimen `seed` as priamos-head does, around the zoom of the looks; throws std::runtime_error
/// if that fails. With `exactly_placed` all other errors are the same.
CalibratedHead CalibrateSpecimen(std::uint64_t seed, bool exactly_placed = false);
/// The same over the whole of zoom and focus, by the shipped plan.
CalibratedHead CalibrateSpecimenWholly(std::uint64_t seed);

/// One stereo pair of a landmark with all that is known of it.
struct LandmarkLook {
  std::array<cv::Mat, 2> images;
  std::array<head::CameraModel, 2> calibrated, exact;
  cv::Mat third;  ///< of the third camera
  head::CameraModel third_calibrated;
  head::HeadSetting setting;                         ///< of the motors
  Pose2 truth, believed;                             ///< base_from_landmark
  Eigen::Matrix3d belief = Eigen::Matrix3d::Zero();  ///< covariance of `believed`
  bool is_there = true;
  double leaf_open_deg = 0;         ///< as it stands, Trouble::kLeafMoved only
  head::LandmarkModel model;        ///< as given to the finder: every edge off by the tolerance
  head::LandmarkModel exact_model;  ///< as built
  Eigen::Matrix<double, 6, 6> base_covariance;
};

/// Tolerances that are drawn, and that the finder is told.
struct LookTolerances {
  double model_sigma_m = 0.001, tilt_sigma_m = 0.00025;
};

/// What the robot looks at.
struct LookStage {
  world::WorldPlan plan;
  GroundPlan map;
  world::SceneConfig light;
  planner::Landmark landmark;  ///< as the planner's map has it
  double distance_m = 2.4;     ///< of the head
  int visit = 0;     ///< later ones: the same landmark, as far off its model, from 1.8 to 3.2 m before it
  double doubt = 1;  ///< how wrong the belief is: 1 up to 20 cm and 5 degrees
  bool choose_lens = false;        ///< zoom and focus for this look, instead of those of all looks
  bool focus_by_distance = false;  ///< world::ImagingConfig

  /// Another time of the day: the windows' light comes from elsewhere, and there is less of it.
  void ChangeLight() { light.window_yaw_deg += 120, light.brightness *= 0.6; }
};

/// Covariance of (x, y, yaw) of what is believed of the landmark: 20 cm and 5 degrees at most.
Eigen::Matrix3d LookBelief();

/// A file of the shipped simulation.
std::string InSim(const std::string& name);

/// The planner's model as the head receives it.
head::LandmarkModel ToHead(const planner::Landmark& landmark);

/// Draws a stereo pair: the landmark straight ahead of where the robot believes to stand, believed wrong by
/// up to 20 cm and 5 degrees; it drives on during the exposure. `side` of the landmark at which the head
/// looks, as in look_request_t; all else goes with the seed. Needs world::Renderer::HoldGraphics.
LandmarkLook TakeLook(const LookStage& stage, const CalibratedHead& head, const LookTolerances& tolerances,
                      int side, std::uint64_t seed);

}  // namespace priamos::bench
