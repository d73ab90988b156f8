#pragma once

#include <optional>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace priamos::robot {

/// Notices a base that gets nowhere on its path, whatever the reason. One that goes to and fro by a hand's
/// breadth before what closes the way stands as well; one that looks for a way about, here and there, drives
/// and yet comes no nearer to the end of its path.
class ProgressWatch {
 public:
  /// For how long a base may get nowhere.
  struct Limits {
    Duration stays;      ///< standing for longer is getting nowhere
    Duration no_nearer;  ///< so is moving for longer without coming nearer to the end
  };

  explicit ProgressWatch(const Limits& limits) : limits_(limits) {}

  /// Begins anew: with another path, and after a hold.
  void Reset();
  /// Whether the base gets nowhere. `odom_from_base`: pose now; `left_m`: length left of its path, turns
  /// included.
  bool GetsNowhere(const Pose2& odom_from_base, double left_m, Time now);

 private:
  struct Anchor {
    Pose2 pose;
    Time since{};
  };
  struct Nearest {
    double left_m = 0;
    Time since{};
  };
  Limits limits_;
  std::optional<Anchor> anchor_;
  std::optional<Nearest> nearest_;  ///< to the end of the path so far
};

}  // namespace priamos::robot
