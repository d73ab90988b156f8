#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "common/input/section_place.hpp"
#include "world/core/scene/camera_quirks.hpp"
#include "world/core/scene/device_faults.hpp"
#include "world/core/scene/holes.hpp"
#include "world/core/scene/leaf_swing.hpp"
#include "world/core/scene/occupancy_grid.hpp"
#include "world/core/scene/person_plan.hpp"
#include "world/core/scene/placed_reference.hpp"
#include "world/core/scene/scene.hpp"
#include "world/core/scene/solid.hpp"
#include "world/core/scene/strewn_plan.hpp"
#include "world/core/scene/survey.hpp"

namespace priamos::world {

/// What the map does not contain about one of its doors: the leaf, and how the door was really built.
struct DoorWork {
  int id = 1;
  std::string hinge = "left";
  double open_deg = 100;
  double open_spread_deg = 0;
  double leaf_thickness_m = 0.04;
  double threshold_m = 0.008;
  std::vector<LeafSwing> swings{};  ///< how somebody moves the leaf
  double built_dx_m = 0, built_dy_m = 0, built_dyaw_deg = 0, built_dwidth_m = 0;
  double built_dheight_m = 0, built_dframe_m = 0, built_dprotrusion_m = 0, built_dthickness_m = 0;
  SectionPlace place{};  ///< where it was read, for errors

  void Describe(Archive& a);
};

/// An upright box: furniture, a column, clutter.
struct BoxPlan {
  std::string name = "box";
  double x_m = 0, y_m = 0, yaw_deg = 0;
  double length_m = 0.5, width_m = 0.5, height_m = 1, bottom_m = 0;
  std::string material = "furniture";
  double spread_m = 0, spread_deg = 0;

  void Describe(Archive& a);
};

/// A flat thing on one face of a wall of the map.
struct PosterPlan {
  std::string wall;
  std::string face = "left";
  double along_m = 1, bottom_m = 1.1, width_m = 0.6, height_m = 0.8;
  std::string material = "poster";
  SectionPlace place{};  ///< where it was read, for errors

  void Describe(Archive& a);
};

/// Boards along the foot of every wall.
struct SkirtingPlan {
  double height_m = 0.08, thickness_m = 0.012;
  std::string material = "skirting";

  void Describe(Archive& a);
};

/// Material of one wall whose surface is not the usual one.
struct WallSurface {
  std::string wall, material = "concrete";
  SectionPlace place{};  ///< where it was read, for errors

  void Describe(Archive& a);
};

/// Where the robot starts: `nominal` is the pose it is given, the truth is off by an error drawn from the
/// seed.
struct StartPlan {
  double x_m = 0, y_m = 0, yaw_deg = 0;
  double x_spread_m = 0, y_spread_m = 0, yaw_spread_deg = 0;
  double error_m = 0.2, error_deg = 5;
  bool anywhere = false;  ///< the truth is any free place of the map, with any heading; the robot is not told

  void Describe(Archive& a);
};

/// The pose the robot is given and the one it has, map frame.
struct Start {
  Pose2 nominal, truth;
};

/// Draws nominal pose (within the spreads) and truth (evenly from the disc of radius error_m, heading evenly
/// within +-error_deg) from the seed.
Start DrawStart(const StartPlan& plan, std::uint64_t seed);

/// The calibration body before the robot: placed at a pose of the base frame at the start, off by what a
/// careful person leaves.
struct ReferencePlan {
  std::string object;
  double x_m = 1.75, y_m = 0, z_m = 1.2, yaw_deg = 180;
  double error_m = 0.0005, error_deg = 0.05;
  SectionPlace place{};  ///< where it was read, for errors

  void Describe(Archive& a);
};

/// Draws the true place of `object` for a robot that starts at `map_from_base`.
PlacedReference PlaceReference(const ReferencePlan& plan, const ReferenceObject& object,
                               const Pose2& map_from_base, std::uint64_t seed);

/// A world file: `config/<deployment>/worlds/*.toml`. File names in it are relative to the deployment's
/// folder.
struct WorldPlan {
  SectionPlace place;  ///< where it was read, for errors
  std::string map;
  std::string wall_material = "plaster";
  std::vector<WallSurface> surfaces;
  SkirtingPlan skirting;
  SurveyPlan survey;
  std::vector<DoorWork> doors;
  std::vector<PosterPlan> posters;
  std::vector<BoxPlan> boxes;
  std::vector<StrewnPlan> strewn;
  std::vector<FreeLane> free_lanes;
  SceneConfig light;
  double brightness_spread = 0, window_spread_deg = 0;
  double camera_light = 0;
  StartPlan start;
  ReferencePlan reference;
  GridPlan grid;
  std::vector<PersonPlan> people;
  std::vector<HolePlan> holes;
  CameraQuirksPlan cameras;
  MastPlan mast;
  FaultsPlan faults;

  void Describe(Archive& a);
};

/// The light of this run: brightness and direction drawn within their spreads.
SceneConfig DrawLight(const WorldPlan& plan, std::uint64_t seed);

}  // namespace priamos::world
