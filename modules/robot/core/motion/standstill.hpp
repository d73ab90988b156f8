#pragma once

#include <optional>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace priamos::robot {

/// Notices a base that gets nowhere on its way, whatever the reason: one that goes to and fro by a hand's
/// breadth before what closes the way stands as well, and is to say so.
class Standstill {
 public:
  void Reset() { anchor_.reset(); }
  /// For how long the base has stayed where it is. `odom_from_base`: pose now.
  Duration Stays(const Pose2& odom_from_base, Time now);

 private:
  struct Anchor {
    Pose2 pose;
    Time since{};
  };
  std::optional<Anchor> anchor_;
};

}  // namespace priamos::robot
