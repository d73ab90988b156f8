#pragma once

#include <Eigen/Core>
#include <span>

#include "head/core/camera/head_model.hpp"

namespace priamos::head {

/// An upright edge to look at: its place on the floor, base frame, and the heights between which it stands.
struct UprightTarget {
  Eigen::Vector2d at{0, 0};
  double bottom_m = 0, top_m = 0;
};

/// The pan angle [rad] at which both pictures show the most of `targets`; of several the one nearest to
/// straight ahead. `base` gives all other axes.
double AimFar(const HeadModel& head, const HeadSetting& base, std::span<const UprightTarget> targets);

}  // namespace priamos::head
