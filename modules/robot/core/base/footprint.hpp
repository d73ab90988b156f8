#pragma once

#include <Eigen/Core>

#include "common/config.hpp"
#include "common/geometry.hpp"

namespace priamos::robot {

/// The base seen from above: a rectangle around the base centre, x forward.
struct Footprint {
  double length_m = 0.95;
  double width_m = 0.78;

  void Describe(Archive& a);

  /// Distance of a point in the base frame from the edge; negative inside.
  double Distance(const Eigen::Vector2d& point) const;
  /// The point of the edge or the inside that is nearest to `point`.
  Eigen::Vector2d Nearest(const Eigen::Vector2d& point) const;
  /// From the centre to a corner.
  double Reach() const;
};

}  // namespace priamos::robot
