#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>

#include "robot/core/base/footprint.hpp"
#include "robot/core/motion/detour.hpp"
#include "robot/core/motion/path_shape.hpp"

namespace priamos::robot {

/// Where a base has driven beside its path: what was free a moment ago, and leads out of a dead end.
class DrivenWay {
 public:
  /// Takes where the base is.
  void Note(const PathPlace& here);
  /// Distance to the left of the path [m] where the base was last at the arc length `s`; nullopt: it was not.
  std::optional<double> At(double s) const;
  void Clear() { offsets_m_.clear(); }

 private:
  std::map<int, double> offsets_m_;  ///< by steps of 5 cm of arc length
};

/// A way out of a dead end: back over what was driven to an arc length of the path, and from there ahead.
struct OtherWay {
  double back_to_m = 0;  ///< arc length from which it leads ahead
  Detour back;           ///< beside the path, to be driven backwards
  Detour onward;
  Things taken = Things::kAsHeard;  ///< how it takes things
};

/// Another way than the one that ends at `here`, things taken so: the cheapest that leads on, from any place
/// of the driven way that is 0.2 to 4 m back, or `also_here`, counting the way back. nullopt: none leads on.
std::optional<OtherWay> FindOtherWay(const DetourConfig& config, const Footprint& footprint,
                                     const PathShape& path, const PathPlace& here,
                                     std::span<const Eigen::Vector2d> things, const DrivenWay& driven,
                                     Things taken = Things::kAsHeard, bool also_here = false);

}  // namespace priamos::robot
