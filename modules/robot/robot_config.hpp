#pragma once

#include <string>

#include "common/archive.hpp"
#include "robot/core/base/mecanum.hpp"
#include "robot/core/features/feature_store.hpp"
#include "robot/core/motion/drive_controller.hpp"
#include "robot/core/pose/localiser.hpp"
#include "robot/core/sonar/opening_watch.hpp"
#include "robot/core/sonar/point_finder.hpp"
#include "robot/core/sonar/segment_finder.hpp"

namespace priamos::robot {

/// Contents of `config/<deployment>/robot.toml`.
struct RobotConfig {
  double rate_hz = 50;         ///< decisions and wheel commands
  double status_rate_hz = 10;  ///< DRIVE_STATUS
  double path_max_age_s = 10;  ///< an older path is refused: it may no longer be wanted
  double order_max_age_s = 2;  ///< older lease requests and orders to re-arm are refused
  std::string state_file;      ///< the e-stop survives a restart here; empty: it does not
  MecanumGeometry base;
  LocaliserConfig localiser;
  OpeningConfig opening;
  SegmentFinderConfig walls;
  PointFinderConfig points;
  FeatureStoreConfig features;
  DriveConfig drive;

  void Describe(Archive& a);
};

}  // namespace priamos::robot
