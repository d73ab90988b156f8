#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"
#include "head/core/calibration/rig/laser_calibration.hpp"
#include "head/files/offline_calibration.hpp"

namespace priamos::head {

/// One picture of the lasers' lines by the third camera, an entry `[[view]]` of a file.
struct LaserPicture {
  std::string image;                                  ///< beside the file that lists it
  double pan_deg = 0, tilt_deg = 0;                   ///< angles of the head at the exposure
  Eigen::Vector3d board_m = Eigen::Vector3d::Zero();  ///< a point of the board, base frame; the floor
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< normal of the board, base frame, any length
  double error_m = 0.0005;                            ///< how exactly the board stands there, 1 sigma
  int line = 0;  ///< the only line that it shows, 1: of the laser that meets the floor nearest; 0: all

  void Describe(Archive& a);
};

/// The pictures from which the lasers are calibrated.
struct LaserPictures {
  int lasers = 1;  ///< how many there are
  std::vector<LaserPicture> views;

  void Describe(Archive& a);
};

/// Work of `priamos calibrate --laser PICTURES --table TABLE`: reads pictures and table, fits the planes of
/// light, writes them into the table (as a whole or not at all; to `output` if that is not empty) and
/// describes them as JSON. Throws ConfigError with one sentence; then no file has changed.
OfflineReport CalibrateLaserFromFiles(const std::string& pictures, const std::string& table,
                                      const std::string& output);

}  // namespace priamos::head
