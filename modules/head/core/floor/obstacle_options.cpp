#include "head/core/floor/obstacle_options.hpp"

#include "common/image_size.hpp"

namespace priamos::head {

void FloorTolerance::Describe(Archive& a) {
  a.Number("heave_m", heave_m, {"m", 0.0001, 0.1, "up and down below the robot, joints included; 1 sigma"});
  a.Number("pitch_rad", pitch_rad, {"rad", 0.0001, 0.1, "angle by which the robot nods; 1 sigma"});
  a.Number("roll_rad", roll_rad, {"rad", 0.0001, 0.1, "angle by which the robot heels; 1 sigma"});
  a.Number("rough_m", rough_m, {"m", 0.0001, 0.05, "roughness of the surface, from place to place; 1 sigma"});
  a.Number("camera_px", camera_px, {"px", 0.01, 5, "how well the third camera is calibrated; 1 sigma"});
}

void ObstacleOptions::Describe(Archive& a) {
  a.Number("min_height_m", min_height_m, {"m", 0.003, 0.2, "what is lower is driven over"});
  a.Number("lowest_m", lowest_m, {"m", -3, -0.01, "deepest that is looked for, against the floor"});
  a.Number("highest_m", highest_m, {"m", 0.01, 3, "highest that is looked for"});
  a.Number("significance", significance, {"-", 3, 20, "sigmas of its height that an obstacle needs"});
  a.Integer("min_columns", min_columns, {"px", 4, 200, "columns of the picture that it needs"});
  a.Integer("min_missing", min_missing,
            {"px", 4, ImageSize{}.width, "a gap in a line is reported if it has more columns"});
  a.Number("min_seen", min_seen,
           {"-", 0, 1, "least share of columns with a line; with less the floor is not judged"});
  // Last: as TOML, what followed would belong to it.
  a.Section("floor", floor, "how a floor may lie");
}

}  // namespace priamos::head
