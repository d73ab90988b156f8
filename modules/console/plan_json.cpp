#include "console/plan_json.hpp"

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;

Json CornersOf(const Rectangle& rectangle) {
  Json corners = Json::array();
  for (const Eigen::Vector2d& corner : rectangle.Corners()) corners.push_back({corner.x(), corner.y()});
  return corners;
}

Json ToJson(const DoorPlan& door) {
  return {{"id", door.id},
          {"name", door.name},
          {"x_m", door.x_m},
          {"y_m", door.y_m},
          {"yaw_rad", door.map_from_door().yaw},
          {"width_m", door.opening_width_m},
          {"depth_m", door.wall_thickness_m}};
}

Json ToJson(const CupboardPlan& cupboard) {
  const Pose2 centre = cupboard.map_from_cupboard() * Pose2{cupboard.depth_m / 2, 0, 0};
  return {{"id", cupboard.id},
          {"name", cupboard.name},
          {"corners", CornersOf({centre, {cupboard.depth_m / 2, cupboard.width_m / 2}})}};
}

}  // namespace

Json ToJson(const GroundPlan& plan) {
  Json json = {{"walls", Json::array()},
               {"doors", Json::array()},
               {"cupboards", Json::array()},
               {"no_go", Json::array()}};
  for (const WallPlan& wall : plan.walls) json["walls"].push_back(CornersOf(wall.Shape()));
  for (const DoorPlan& door : plan.doors) json["doors"].push_back(ToJson(door));
  for (const CupboardPlan& cupboard : plan.cupboards) json["cupboards"].push_back(ToJson(cupboard));
  for (const NoGoPlan& area : plan.no_go)
    json["no_go"].push_back({{"name", area.name}, {"corners", CornersOf(area.Shape())}});
  return json;
}

}  // namespace priamos::console
