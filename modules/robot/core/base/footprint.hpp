#pragma once

#include <Eigen/Core>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/robot/body_size.hpp"

namespace priamos::robot {

/// The base seen from above: a rectangle around the base centre, x forward.
struct Footprint {
  double length_m = kDrawnBody.length_m;
  double width_m = kDrawnBody.width_m;

  void Describe(Archive& a);

  /// Distance of a point in the base frame from the edge; negative inside.
  double Distance(const Eigen::Vector2d& point) const;
  /// The point of the edge or the inside that is nearest to `point`.
  Eigen::Vector2d Nearest(const Eigen::Vector2d& point) const;
  /// Length and width [m].
  Eigen::Vector2d Size() const { return {length_m, width_m}; }
  /// Distance from the centre to a corner [m].
  double Reach() const;
};

}  // namespace priamos::robot
