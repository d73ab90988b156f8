#include "world/core/scene/scene.hpp"

namespace priamos::world {

const std::vector<std::string>& MaterialNames() {
  static const std::vector<std::string> kNames = {
      "plaster", "concrete",  "wood",     "door_frame", "door_leaf", "skirting", "lino",   "tiles", "carpet",
      "ceiling", "furniture", "cupboard", "metal",      "cardboard", "fabric",   "poster", "glass", "mirror"};
  return kNames;
}

bool IsGlass(const std::string& material) {
  return material == "glass";
}

bool IsMirror(const std::string& material) {
  return material == "mirror";
}

void SceneConfig::Describe(Archive& a) {
  a.Number("x_min_m", x_min_m, {"m", -1000, 1000, "floor and ceiling, map"});
  a.Number("x_max_m", x_max_m, {"m", -1000, 1000, "floor and ceiling, map"});
  a.Number("y_min_m", y_min_m, {"m", -1000, 1000, "floor and ceiling, map"});
  a.Number("y_max_m", y_max_m, {"m", -1000, 1000, "floor and ceiling, map"});
  if (x_max_m <= x_min_m) a.Refuse("x_max_m", "more than x_min_m");
  if (y_max_m <= y_min_m) a.Refuse("y_max_m", "more than y_min_m");
  a.Number("ceiling_m", ceiling_m, {"m", 1.5, 20, "height of the ceiling"});
  a.Choice("floor", floor, MaterialNames(), "what the floor is made of");
  a.Number("brightness", brightness, {"-", 0, 4, "brightness of all light together"});
  a.Number("ambient", ambient, {"-", 0, 1, "share of the light that comes from everywhere"});
  a.Number("window", window, {"-", 0, 1, "share of the light that comes from windows; the rest is lamps"});
  if (ambient + window > 1) a.Refuse("window", "at most 1 together with ambient");
  a.Number("window_yaw_deg", window_yaw_deg, {"deg", -360, 360, "map direction towards the windows"});
  a.Number("window_elevation_deg", window_elevation_deg, {"deg", -90, 90, "their height above the horizon"});
  a.Number("lamp_spacing_m", lamp_spacing_m, {"m", 0.5, 20, "grid of lamps under the ceiling"});
}

}  // namespace priamos::world
