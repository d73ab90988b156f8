#pragma once

#include <string>
#include <vector>

#include "common/config.hpp"

namespace priamos::world {

/// Room and light around the solids.
struct SceneConfig {
  double ceiling_m = 2.8;                                       ///< height of the ceiling
  double x_min_m = -8, x_max_m = 8, y_min_m = -6, y_max_m = 6;  ///< extent of floor and ceiling in the map
  std::string floor = "lino";                                   ///< material
  double brightness = 1.0;                                      ///< of all lamps together
  double ambient = 0.45;                              ///< share of the light that comes from everywhere
  double lamp_x = 0.45, lamp_y = 0.3, lamp_z = 0.84;  ///< direction towards the main light

  void Describe(Archive& a);
};

/// Every material a Solid may have.
const std::vector<std::string>& MaterialNames();

}  // namespace priamos::world
