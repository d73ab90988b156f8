#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "common/geometry.hpp"

namespace priamos::console {

/// A place on the plan, map frame.
struct Target {
  Pose2 map_from_base;
  bool turn = true;  ///< the heading counts
};

/// An order to the planner.
struct MissionOrder {
  /// What the planner is to do.
  enum class Kind {
    kAbort,
    kPause,
    kResume,
    kCancel,
    kPassDoor,
    kGoto,
    kCorridor,
    kExplore,
    kLocate,
    kPatrol
  };
  /// Most places of a patrol.
  static constexpr std::size_t kMostPlaces = 12;

  Kind kind = Kind::kAbort;
  int landmark_id = 0;         ///< door to pass
  std::optional<Target> goal;  ///< place; of a corridor its direction, if any
  double distance_m = 0;       ///< how far to follow the corridor, 0: to its end
  int order_id = 0;            ///< order to cancel
  std::vector<Target> places;  ///< of a patrol, in turn
  int rounds = 1;              ///< of a patrol; 0: until it is cancelled
};

/// A pose of the base in the map: x_m, y_m, yaw_rad. Throws Wrong as json_fields.hpp does.
Pose2 ReadPlaceFields(const nlohmann::json& object);
/// The order in a page's message of the type `mission`. Throws Wrong as json_fields.hpp does.
MissionOrder ReadMissionOrder(const nlohmann::json& object);

}  // namespace priamos::console
