#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/rectangle.hpp"

namespace priamos {

/// Numbers that landmarks of a map can have; in a message 0 means none.
inline constexpr int kFirstLandmarkId = 1, kLastLandmarkId = 999;

/// A straight wall: a rectangle around its centre line.
struct WallPlan {
  std::string name;
  std::vector<double> from_m{0, 0};  ///< map, one end of the centre line: x, y
  std::vector<double> to_m{0, 0};    ///< map, the other end
  double thickness_m = 0.14;

  void Describe(Archive& a);
  Eigen::Vector2d from() const { return {from_m[0], from_m[1]}; }
  Eigen::Vector2d to() const { return {to_m[0], to_m[1]}; }
  Rectangle Shape() const;
};

/// A door with a frame on the side it is approached from and, on the far side, a rebate for its leaf.
///
/// Its landmark frame stands on the floor in the middle of the opening, half way through the wall; x points
/// through the opening in driving direction, y left, z up. Seen from above (driving direction to the right):
///
///       frame (architrave)       |<- wall_thickness_m ->|
///          .--.  y = width/2 + frame_width_m
///          |  |__________________________
///          |  |           wall            |
///          |  '---                ,-------'  <- rebate: the last rebate_depth_m are rebate_width_m wider
///          '----------------------'  y = width/2 (inner face of the jamb)
///          ^ front arris          ^ stop arris
struct DoorPlan {
  int id = 1;
  std::string name;
  double x_m = 0, y_m = 0;         ///< map, origin of the landmark frame
  double yaw_deg = 0;              ///< map, its x axis
  double opening_width_m = 0.90;   ///< clear, between the inner faces
  double opening_height_m = 2.00;  ///< clear
  double wall_thickness_m = 0.14;
  double frame_width_m = 0.06;        ///< breadth of the frame's face beside and above the opening
  double frame_protrusion_m = 0.015;  ///< how far that face stands before the wall
  double rebate_depth_m = 0.04;       ///< how deep the leaf sits in the far side
  double rebate_width_m = 0.015;      ///< how much wider the opening is there, on each side and above
  std::string leaf = "unknown";  ///< hinges of the leaf, "left" or "right", if its angle is known; or "none"
  double leaf_open_deg = 0;      ///< 0 is closed; it opens into the far room
  double leaf_thickness_m = 0.04;
  double frame_over_wall = 0;  ///< how many times as bright the frame's face is as the wall; 0: not known
  int behind_id = 0;  ///< number of its landmark for who stands behind it; 0: nobody looks at it from there

  void Describe(Archive& a);

  Pose2 map_from_door() const { return {x_m, y_m, Radians(yaw_deg)}; }
  /// Coordinates x [m] of the planes on which the edges lie, landmark frame.
  double FrontX() const { return -wall_thickness_m / 2 - frame_protrusion_m; }
  double StopX() const { return wall_thickness_m / 2 - rebate_depth_m; }
  double BackX() const { return wall_thickness_m / 2; }
};

/// Where the leaf of a door stands: an upright box in the door's landmark frame.
struct LeafShape {
  Pose2 door_from_leaf;  ///< centre
  Eigen::Vector2d size_m;
  double z_min_m = 0, z_max_m = 0;
};

/// The leaf hinged on `hinge` ("left" or "right"). Closed it fills the rebate; it turns about the pin of
/// swing-clear hinges into the far room.
LeafShape LeafOf(const DoorPlan& door, const std::string& hinge, double open_deg, double thickness_m);

/// A cupboard or shelf that stands with its back to something and is known well enough to be a landmark.
/// Origin: middle of its front on the floor; x points into it.
struct CupboardPlan {
  int id = 1;
  std::string name;
  double x_m = 0, y_m = 0;  ///< map, origin
  double yaw_deg = 0;       ///< map, direction into the cupboard
  double width_m = 1.0, depth_m = 0.4, height_m = 1.8;
  int n_doors = 2;               ///< side by side
  double gap_m = 0.004;          ///< between two doors
  double plinth_m = 0.09;        ///< height of the plinth under the doors, 0 if there is none
  double plinth_over_front = 0;  ///< how many times as bright the plinth is as the doors; 0: not known

  void Describe(Archive& a);

  Pose2 map_from_cupboard() const { return {x_m, y_m, Radians(yaw_deg)}; }
};

/// A part of the floor that is not to be driven on: before a staircase, a laboratory's experiment.
struct NoGoPlan {
  std::string name;
  double x_m = 0, y_m = 0;  ///< map, its middle
  double yaw_deg = 0;       ///< map, direction of its length
  double length_m = 1, width_m = 1;

  void Describe(Archive& a);

  Rectangle Shape() const { return {{x_m, y_m, Radians(yaw_deg)}, {length_m / 2, width_m / 2}}; }
};

/// The plan of a building as far as driving needs it: `config/<deployment>/maps/*.toml`.
struct GroundPlan {
  double wall_sigma_m = 0.05;  ///< how far an end of a wall may be beside its place, one sigma
  std::vector<WallPlan> walls;
  std::vector<DoorPlan> doors;
  std::vector<CupboardPlan> cupboards;
  std::vector<NoGoPlan> no_go;

  void Describe(Archive& a);
  /// Door of this id; nullptr if there is none.
  const DoorPlan* FindDoor(int id) const;
};

}  // namespace priamos
