#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "head/core/scene/level_borders.hpp"
#include "head/core/scene/scene_object.hpp"

namespace priamos::head {

/// How borders are put together.
struct TableTopOptions {
  double thickness_m = 0.05;     ///< a top is taken for so thick
  double apart_m = 0.25;         ///< borders of one height that are nearer are of one top ...
  double square_rad = 0.2;       ///< ... if they are parallel or square to each other
  double same_height_m = 0.02;   ///< one height: within this and 3 sigmas
  double min_depth_m = 0.08;     ///< what is narrower is told as a border
  double under_m = 0.12;         ///< what lies so far below a top, or less, is its lower arris
  double beside_m = 0.06;        ///< what is so near to a thing that is known already belongs to it
  double frame_sigma_m = 0.003;  ///< error of the calibrated base frame
  double end_sigma_m = 0.03;     ///< along a border: it may go on where it is hidden
  double yaw_sigma_rad = 0.01;
};

/// Things that hang, from their level borders: the rectangle around all that are of one height and near each
/// other, lines on the top itself among them, is a top (a flat box), a border alone a low face. What belongs
/// to one of `standing` is left out.
std::vector<SceneObject> GroupBorders(std::span<const LevelBorder> borders,
                                      std::span<const SceneObject> standing, const Eigen::Vector3d& eye,
                                      const TableTopOptions& options);

}  // namespace priamos::head
