#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "robot/core/sonar/placed_echo.hpp"

namespace priamos::robot {

/// A line by its normal form: the normal's angle, and the distance of the origin of the odometry along it.
struct VotedLine {
  double angle_rad = 0, distance_m = 0;
  int votes = 0;
};

/// Hough transform of echoes for walls: an echo votes for every line that touches its arc, as a smooth wall
/// does (regions of constant depth: Leonard and Durrant-Whyte, "Directed Sonar Sensing for Mobile Robot
/// Navigation", 1992). Angles in steps of 2 degrees, distances in steps of 5 cm, of which those that are a
/// multiple of 12.8 m apart share a cell: more than two walls that a base hears at once.
class LineVotes {
 public:
  LineVotes();

  void Add(const PlacedEcho& echo) { Vote(echo, 1); }
  void Remove(const PlacedEcho& echo) { Vote(echo, -1); }
  /// The line with the most votes of those that `echo` votes for.
  VotedLine Best(const PlacedEcho& echo) const;

 private:
  static constexpr int kAngles = 180, kDistances = 256;
  void Vote(const PlacedEcho& echo, int change);
  int At(int angle, int distance) const;

  std::vector<std::int16_t> cells_;
};

}  // namespace priamos::robot
