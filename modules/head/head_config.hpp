#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"
#include "head/core/calibration/rig/calibration_plan.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/drift/drift_monitor.hpp"
#include "head/core/floor/laser_watch.hpp"
#include "head/core/motion/ahead_watch.hpp"
#include "head/core/motion/follow_up.hpp"
#include "head/core/motion/gaze.hpp"
#include "head/core/motion/head_positioner.hpp"
#include "head/core/motion/look_sequence.hpp"
#include "head/core/motion/side_watch.hpp"
#include "head/video_config.hpp"

namespace priamos::head {

/// How a landmark is searched and when a fix is believed; the rest of LandmarkFixOptions follows from
/// geometry.
struct VisionConfig {
  double min_contrast = 8;         ///< weakest edge of a well exposed picture [grey values]
  double usual_grey = 80;          ///< mean of such a picture; in darker ones weaker edges count
  double min_edge_px = 12;         ///< shortest edge
  double model_sigma_m = 0.005;    ///< how well landmark models are known, each edge and axis
  double breadth_sigma_m = 0.012;  ///< how well the breadth of a landmark is known
  double height_sigma_m = 0.006;   ///< how well its height is known
  double depth_sigma_m = 0.005;    ///< how well it is known how far its faces stand out
  double camera_sigma_px = 0.05;   ///< how well the cameras are calibrated and the motors return
  double min_log_odds = 7;         ///< evidence wanted beyond chance
  double min_lead = 6;             ///< evidence wanted over the next best pose
  bool third_camera = false;       ///< takes part in looks where it is calibrated

  void Describe(Archive& a);
};

/// Where the reference object stands during a calibration.
struct ReferencePose {
  std::string object = "reference_object.toml";  ///< its discs, beside the configuration file
  double x_m = 1.75, y_m = 0, z_m = 1.20;        ///< its origin in the base frame
  double yaw_deg = 180;                          ///< direction of its x axis, which points out of its front
  double error_m = 0.0005, error_deg = 0.05;     ///< how exactly it stands there: 1 sigma, each axis

  void Describe(Archive& a);
};

/// Contents of `config/<deployment>/head.toml`.
struct HeadConfig {
  double rate_hz = 50;                      ///< decisions
  std::string mode = "look";                ///< look or calibrate
  std::string calibration = "kastor.yaml";  ///< table of head setups, beside the configuration file
  std::string pictures;           ///< folder from which pictures come instead of the cameras; none: empty
  std::string keep_pictures;      ///< folder in which the pictures used are kept; none: empty
  double tilt_deg = 0;            ///< for all looks; farther up as `look_up` says
  double convergence_deg = 1.15;  ///< each camera is turned so far towards the middle
  int zoom_step = 650;
  int focus_step = 1600;
  AimConfig aim;
  TiltConfig look_up;
  LensChoiceConfig lens;
  ReferencePose reference;
  CalibrationPlan plan;
  HeadGeometry drawing;  ///< where a calibration starts
  PositionerConfig motors;
  LookConfig look;
  FollowConfig follow;
  VisionConfig vision;
  DriftConfig drift;
  LaserWatchConfig laser;
  SideWatchConfig doors;
  AheadWatchConfig scene;
  VideoConfig video;

  void Describe(Archive& a);
  /// Setting of all looks; each look sets the pan itself, and with `lens.choose` zoom and focus.
  HeadSetting LookSetting() const;
  /// How it is chosen.
  GazeConfig Gaze() const { return {LookSetting(), aim, look_up, lens, motors.approach_steps}; }
  /// Setting at which the third camera sees the laser's line.
  HeadSetting WatchSetting() const;
};

}  // namespace priamos::head
