#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/archive.hpp"

namespace priamos::world {

/// Floor that stays free: a straight strip, map frame.
struct FreeLane {
  std::vector<double> from_m{0, 0}, to_m{1, 0};  ///< ends of its middle line: x, y
  double half_m = 0.85;                          ///< half its width; it reaches as far beyond its ends

  void Describe(Archive& a);
  /// Distance of a point from the strip [m], negative in it.
  double DistanceTo(const Eigen::Vector2d& at) const;
};

/// Things that are on nobody's plan: how many there are, which and where is drawn from the seed. None is put
/// into a free lane.
struct StrewnPlan {
  std::string kind = "any";
  std::vector<double> low_m{0, 0}, high_m{1, 1};  ///< corners of the floor where they may stand: x, y
  int least = 0, most = 1;                        ///< how many

  void Describe(Archive& a);
};

/// What can be strewn, without "any".
const std::vector<std::string>& StrewnKinds();

}  // namespace priamos::world
