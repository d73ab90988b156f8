#pragma once

#include "common/archive.hpp"
#include "common/rectangle.hpp"
#include "common/robot/body_size.hpp"

namespace priamos::planner {

/// The body that has to fit: a rectangle around the base centre, x forward.
struct Footprint {
  double length_m = kDrawnBody.length_m;
  double width_m = kDrawnBody.width_m;
  double height_m = kDrawnBody.height_m;

  void Describe(Archive& a) {
    a.Number("length_m", length_m, {"m", 0.1, 3, "along the base's x axis"});
    a.Number("width_m", width_m, {"m", 0.1, 3, "along the base's y axis"});
    a.Number("height_m", height_m, {"m", 0.1, 3, "height of the tallest part, the camera head"});
  }

  Rectangle At(const Pose2& map_from_base) const { return {map_from_base, {length_m / 2, width_m / 2}}; }
};

}  // namespace priamos::planner
