#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/learned/learned_door.hpp"
#include "common/learned/learned_object.hpp"
#include "common/learned/learned_point.hpp"
#include "common/rectangle.hpp"

namespace priamos {

/// A straight piece of wall as a robot found it: from its middle half its length forwards and backwards.
struct LearnedWall {
  int id = 0;
  double x_m = 0, y_m = 0;  ///< map, its middle
  double yaw_deg = 0;       ///< map, its direction; the robot was to the left
  double length_m = 0;
  double sigma_across_m = 0;  ///< of its middle, across it
  double sigma_yaw_deg = 0;
  double rho = 0;          ///< correlation of middle (positive to the left) and direction
  double sigma_end_m = 0;  ///< of both ends, along it
  double seen_s = 0;       ///< since 1970, when it was heard last
  int sightings = 1;       ///< how often a robot told of it

  void Describe(Archive& a);

  Pose2 map_from_wall() const { return {x_m, y_m, Radians(yaw_deg)}; }
  Eigen::Vector2d At(double along_m) const { return map_from_wall() * Eigen::Vector2d(along_m, 0); }
  Eigen::Vector2d from() const { return At(-length_m / 2); }
  Eigen::Vector2d to() const { return At(length_m / 2); }
  /// Of (middle across it, direction) [m, rad].
  Eigen::Matrix2d covariance() const;
  void SetCovariance(const Eigen::Matrix2d& covariance);
  /// Standard deviation across it, so far from its middle [m].
  double SigmaAt(double along_m) const;
};

/// What a planner has learned of a building, in a file of its own: the surveyed plan stays as it is.
struct LearnedWalls {
  static constexpr int kVersion = 1;

  int version = kVersion;  ///< of the file's form
  int revision = 0;        ///< counts the changes
  std::vector<LearnedWall> walls;
  std::vector<LearnedDoor> doors;        ///< in the order in which they were found
  std::vector<LearnedObject> objects{};  ///< in the order in which they were told last
  std::vector<LearnedPoint> points{};    ///< inner corners and edges

  void Describe(Archive& a);
};

/// Where a planner keeps it when a deployment says nothing else.
inline constexpr std::string_view kLearnedMapFile = "learned-map.toml";

/// The learned map of a file; an empty one when there is no such file. Throws ConfigError for a damaged one.
LearnedWalls LoadLearnedWalls(const std::string& path);
/// Replaces the file as a whole. Returns false with errno set when it failed.
bool SaveLearnedWalls(const std::string& path, const LearnedWalls& walls);

}  // namespace priamos
