#pragma once

#include <string>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/ground_plan.hpp"

namespace priamos {

/// A door as a robot's head found it, driving past.
struct LearnedDoor {
  int id = 0;
  double x_m = 0, y_m = 0;  ///< map, middle of its opening
  double yaw_deg = 0;       ///< map, through it, away from where it was seen
  double width_m = 0.9;     ///< between its uprights: edges of the opening or of the frame
  double sigma_along_m = 0, sigma_across_m = 0;  ///< of its middle, along the wall and across it
  std::string state = "unknown";                 ///< closed, ajar or open
  double state_log_odds = 0;                     ///< against the next best state
  double changed_s = 0;                          ///< since 1970, when another state was seen last; 0: never
  double seen_s = 0;                             ///< since 1970, when it was seen last
  int looks = 1;                                 ///< that showed it

  void Describe(Archive& a);
  Pose2 map_from_door() const { return {x_m, y_m, Radians(yaw_deg)}; }
};

/// Doors nearer to each other are one.
inline constexpr double kSameDoor_m = 0.65;

/// The plan's door that this is; nullptr: the plan has none there.
const DoorPlan* DoorOnPlan(const LearnedDoor& door, const GroundPlan& plan);

/// `door 3 'library'`; without the name where the plan has no door.
std::string NameOf(const LearnedDoor& door, const GroundPlan& plan);

}  // namespace priamos
