#pragma once

#include <utility>
#include <variant>

#include "common/learned/learned_walls.hpp"

namespace priamos::planner {

/// By what a robot names a feature: the store, and the number in it, which means something there only.
using FeatureName = std::pair<int, int>;

/// A feature as a robot tells of it. Whatever it told under this number before, of this kind or another, is
/// replaced by it.
struct SeenFeature {
  int store = 0, id = 0;
  /// A wall or a point, whose own id and sightings mean nothing; nothing: the robot saw through it.
  std::variant<std::monostate, LearnedWall, LearnedPoint> what{};
  double own_sigma_m = 0;  ///< of a point against the base that heard it, in any direction at most
  double towards_rad = 0;  ///< direction from the base to a point when it was found

  FeatureName name() const { return {store, id}; }
  bool gone() const { return std::holds_alternative<std::monostate>(what); }
  const LearnedWall* wall() const { return std::get_if<LearnedWall>(&what); }
  const LearnedPoint* point() const { return std::get_if<LearnedPoint>(&what); }
};

}  // namespace priamos::planner
