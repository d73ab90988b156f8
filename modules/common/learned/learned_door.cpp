#include "common/learned/learned_door.hpp"

#include <fmt/format.h>

#include "common/learned/required_place.hpp"

namespace priamos {

void LearnedDoor::Describe(Archive& a) {
  a.Integer("id", id, {"-", 1, 1e9, "number of the door"});
  a.Number("x_m", x_m, {"m", -200, 200, "map, middle of its opening"});
  a.Number("y_m", y_m, {"m", -200, 200, "map, middle of its opening"});
  a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "map, through it, away from where it was seen"});
  a.Number("width_m", width_m, {"m", 0, 10, "between its uprights"});
  a.Number("sigma_along_m", sigma_along_m, {"m", 0, 100, "standard deviation of its middle along the wall"});
  a.Number("sigma_across_m", sigma_across_m, {"m", 0, 100, "and across the wall"});
  a.Choice("state", state, {"unknown", "closed", "ajar", "open"}, "of its leaf, when it was told last");
  a.Number("state_log_odds", state_log_odds, {"-", 0, 1000, "of that state against the next best one"});
  a.Number("changed_s", changed_s, {"s", 0, 1e11, "since 1970, when another state was seen; 0: never"});
  a.Number("seen_s", seen_s, {"s", 0, 1e11, "since 1970, when it was seen last"});
  a.Integer("looks", looks, {"-", 1, 1e9, "how many showed it"});
  RequirePlace(a, "the number of the door");
}

const DoorPlan* DoorOnPlan(const LearnedDoor& door, const GroundPlan& plan) {
  for (const DoorPlan& drawn : plan.doors)
    if ((Eigen::Vector2d(drawn.x_m, drawn.y_m) - Eigen::Vector2d(door.x_m, door.y_m)).norm() < kSameDoor_m)
      return &drawn;
  return nullptr;
}

std::string NameOf(const LearnedDoor& door, const GroundPlan& plan) {
  const DoorPlan* drawn = DoorOnPlan(door, plan);
  return drawn ? fmt::format("door '{}'", drawn->name) : fmt::format("door {}", door.id);
}

}  // namespace priamos
