#include "planner/core/map/map_landmarks.hpp"

#include "planner/core/map/cupboard_landmark.hpp"
#include "planner/core/map/door_landmark.hpp"

namespace priamos::planner {

std::optional<Landmark> MakeLandmark(const GroundPlan& plan, int id) {
  if (const DoorPlan* door = plan.FindDoor(id)) return MakeDoorLandmark(*door);
  for (const DoorPlan& door : plan.doors)
    if (id != 0 && door.behind_id == id) return MakeDoorLandmarkFromBehind(door);
  for (const CupboardPlan& cupboard : plan.cupboards)
    if (cupboard.id == id) return MakeCupboardLandmark(cupboard);
  return std::nullopt;
}

}  // namespace priamos::planner
