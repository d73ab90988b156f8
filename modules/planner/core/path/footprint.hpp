#pragma once

#include "common/config.hpp"
#include "common/rectangle.hpp"

namespace priamos::planner {

/// The body that has to fit: a rectangle around the base centre, x forward.
struct Footprint {
  double length_m = 0.95;
  double width_m = 0.78;
  double height_m = 1.40;

  void Describe(Archive& a) {
    a.Number("length_m", length_m, {"m", 0.1, 3, "along the base's x axis"});
    a.Number("width_m", width_m, {"m", 0.1, 3, "along the base's y axis"});
    a.Number("height_m", height_m, {"m", 0.1, 3, "of the tallest part, the camera head"});
  }

  Rectangle At(const Pose2& map_from_base) const { return {map_from_base, {length_m / 2, width_m / 2}}; }
};

}  // namespace priamos::planner
