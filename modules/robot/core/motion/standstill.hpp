#pragma once

#include <optional>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace priamos::robot {

/// Notices a base that gets nowhere on its way, whatever the reason: one that goes to and fro by a hand's
/// breadth before what closes the way stands as well, and is to say so.
class Standstill {
 public:
  explicit Standstill(double after_s) : after_s_(after_s) {}

  void Reset() { anchor_.reset(); }
  /// Whether the base has stayed where it is for longer than `after_s`. `odom_from_base`: pose now.
  bool Stays(const Pose2& odom_from_base, Time now);

 private:
  struct Anchor {
    Pose2 pose;
    Time since{};
  };
  double after_s_;
  std::optional<Anchor> anchor_;
};

}  // namespace priamos::robot
