#pragma once

#include <string>

#include "common/geometry.hpp"
#include "common/outcome.hpp"
#include "common/robot/leeway.hpp"
#include "planner/core/map/obstacle_map.hpp"
#include "planner/core/path/footprint.hpp"

namespace priamos::planner {

/// The pose at `part` (0 to 1) of a straight line along which the heading turns evenly, the shorter way
/// round.
Pose2 Between(const Pose2& from, const Pose2& to, double part);

/// The true footprint among the obstacles of a map: what is free where it stands, and along straight lines
/// with evenly turning heading. Checked in steps of 5 mm at most where it matters.
class SweptFootprint {
 public:
  /// Smallest distance to an obstacle, and which one it is.
  struct Gap {
    double distance_m = std::numeric_limits<double>::infinity();
    std::string obstacle;
  };

  SweptFootprint(const Footprint& footprint, ObstacleMap obstacles);

  const Footprint& footprint() const { return footprint_; }
  const ObstacleMap& obstacles() const { return obstacles_; }
  /// Adds something that must not be touched.
  void Add(std::string name, const Rectangle& shape) { obstacles_.Add(std::move(name), shape); }

  Gap At(const Pose2& map_from_base) const;
  double DistanceAt(const Pose2& map_from_base) const {
    return obstacles_.NearestTo(footprint_.At(map_from_base)).distance_m;
  }
  /// Of the circle around the footprint [m].
  double radius_m() const { return radius_m_; }
  Gap Along(const Pose2& from, const Pose2& to) const;
  /// Whether Along(from, to) is at least `margin_m`: much faster.
  bool IsFree(const Pose2& from, const Pose2& to, double margin_m) const;
  /// How far the base may be moved to either side on its whole line, up to 2 m in steps of 10 cm, while it
  /// keeps `margin_m`.
  Leeway LeewayOf(const Pose2& from, const Pose2& to, double margin_m) const;

 private:
  /// The farthest that any point of the footprint moves on the line [m].
  double Travel(const Pose2& from, const Pose2& to) const;
  double FreeBeside(const Pose2& from, const Pose2& to, double side, double margin_m) const;

  Footprint footprint_;
  ObstacleMap obstacles_;
  double radius_m_;
};

/// Why no way begins where the base stands: the map has `obstacle` there. With the next step.
Refusal StandsIn(const Pose2& map_from_base, const std::string& obstacle);

}  // namespace priamos::planner
