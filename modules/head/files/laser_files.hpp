#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"
#include "head/core/calibration/rig/laser_calibration.hpp"
#include "head/files/offline_calibration.hpp"

namespace priamos::head {

/// One picture of the laser's line by the third camera, an entry `[[view]]` of a file.
struct LaserPicture {
  std::string image;                                  ///< beside the file that lists it
  double pan_deg = 0, tilt_deg = 0;                   ///< angles of the head at the exposure
  Eigen::Vector3d board_m = Eigen::Vector3d::Zero();  ///< a point of the board, base frame; the floor
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< normal of the board, base frame, any length
  double error_m = 0.0005;                            ///< how exactly the board stands there, 1 sigma

  void Describe(Archive& a);
};

/// The pictures from which the laser is calibrated.
struct LaserPictures {
  std::vector<LaserPicture> views;

  void Describe(Archive& a);
};

/// Work of `priamos calibrate --laser PICTURES --table TABLE`: reads pictures and table, fits the plane of
/// light, writes it into the table (as a whole or not at all; to `output` if that is not empty) and describes
/// it as JSON. Throws ConfigError with one sentence; then no file has changed.
OfflineReport CalibrateLaserFromFiles(const std::string& pictures, const std::string& table,
                                      const std::string& output);

}  // namespace priamos::head
