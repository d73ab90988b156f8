#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>

#include "bus/log/log_reader.hpp"
#include "bus/log/log_selection.hpp"

namespace priamos::cli {

/// What of a log has gone into a file of MRPT's.
struct MrptCount {
  std::size_t cycles = 0;   ///< of the sonars
  std::size_t places = 0;   ///< of the base
  std::size_t refused = 0;  ///< messages that cannot be decoded, left out
};

/// Writes ODOMETRY and SONAR_RANGES as CObservationOdometry and CObservationRange, in the order of the log: a
/// rawlog, as RawLogViewer and rawlog-edit open it (compressed). `footprint_m`: length and width of the base,
/// on whose edge the sonars sit. Throws std::runtime_error when `file` cannot be written.
MrptCount WriteRawlog(bus::LogReader& log, const bus::LogSelection& selection,
                      const Eigen::Vector2d& footprint_m, const std::string& file);

/// Writes a CSimpleMap: each time that the base has moved by 10 cm or turned by 5 degrees the sonars' cycle
/// with the POSE before it and its covariance, for observations2map and the like.
MrptCount WriteSimplemap(bus::LogReader& log, const bus::LogSelection& selection,
                         const Eigen::Vector2d& footprint_m, const std::string& file);

}  // namespace priamos::cli
