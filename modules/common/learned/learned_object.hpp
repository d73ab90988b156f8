#pragma once

#include <cstddef>
#include <string>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/rectangle.hpp"

namespace priamos {

/// Something that stands on the floor, as a robot's head put it together from straight edges of space.
struct LearnedObject {
  int id = 0;
  std::string kind = "edge";       ///< edge: an upright edge; face: an upright rectangle; box: two that meet
  double x_m = 0, y_m = 0;         ///< map, middle of its front on the floor
  double yaw_deg = 0;              ///< map, square to the front, away from where it was seen: into the thing
  double width_m = 0;              ///< of the front; 0 of an edge
  double depth_m = 0;              ///< behind the front, of a box; 0: not known
  double bottom_m = 0, top_m = 0;  ///< above the floor, as far as it was seen
  double sigma_along_m = 0, sigma_across_m = 0;  ///< of that middle, along the front and square to it
  double sigma_yaw_deg = 0;
  double seen_s = 0;  ///< since 1970, when it was seen last
  int looks = 1;      ///< that showed it; 0: it has gone

  int told_id = -1;  ///< its number in the head that told it; not kept in files

  void Describe(Archive& a);
  Pose2 map_from_front() const { return {x_m, y_m, Radians(yaw_deg)}; }
  /// What it covers of the floor. A thing of which nobody knows how deep it is covers 5 cm behind its front,
  /// an edge a point.
  Rectangle Footprint() const;
};

/// As many are kept.
inline constexpr std::size_t kMostObjects = 300;

/// `thing 3`.
std::string NameOf(const LearnedObject& object);
/// `0.60 x 0.40 m`, of a face `0.60 m wide`, of an edge `an edge`.
std::string SizeOf(const LearnedObject& object);

}  // namespace priamos
