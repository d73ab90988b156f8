#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"
#include "world/core/scene/holes.hpp"

namespace priamos::world {

/// Room and light around the solids.
struct SceneConfig {
  double x_min_m = -8, x_max_m = 8, y_min_m = -6, y_max_m = 6;  ///< floor and ceiling, map
  double ceiling_m = 2.8;
  std::string floor = "lino";
  double brightness = 1.2;     ///< brightness of all light together
  double ambient = 0.35;       ///< share of the light that comes from everywhere
  double window = 0.3;         ///< share that comes from the windows, the rest from ceiling lamps
  double window_yaw_deg = 60;  ///< map direction towards the windows
  double window_elevation_deg = 20;
  double lamp_spacing_m = 2.4;    ///< grid of lamps under the ceiling
  std::vector<HolePlan> holes{};  ///< where there is no floor; a key of the world file, not of the light

  void Describe(Archive& a);
};

/// Every material a Solid may have: how it looks. Front and back of a "poster", a "door_leaf" and a
/// "cupboard" show one picture each; "glass" is not seen at all, a "mirror" is an even grey; the others are
/// covered evenly.
const std::vector<std::string>& MaterialNames();

/// Materials that light goes through, or that throw it back like a mirror: the line laser draws nothing
/// there.
bool IsGlass(const std::string& material);
bool IsMirror(const std::string& material);

}  // namespace priamos::world
