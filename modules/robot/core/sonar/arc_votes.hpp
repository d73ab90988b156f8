#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "robot/core/sonar/placed_echo.hpp"

namespace priamos::robot {

/// A place on the floor and how many echoes may have come from it.
struct VotedPlace {
  Eigen::Vector2d at{0, 0};  ///< frame of the odometry [m]
  int votes = 0;
};

/// Echoes vote for the places on their arcs: where arcs of a moving base cross stands what echoes to all
/// sides, a corner or an edge (Wijk and Christensen, "Triangulation-based fusion of sonar data", 2000). Cells
/// of 10 cm, of which those that are a multiple of 12.8 m apart share their votes: more than two places that
/// a base hears at once.
class ArcVotes {
 public:
  ArcVotes();

  void Add(const PlacedEcho& echo) { Vote(echo, 1); }
  void Remove(const PlacedEcho& echo) { Vote(echo, -1); }
  /// The place on the arc of `echo` with the most votes, those of the cells beside it included.
  VotedPlace Best(const PlacedEcho& echo) const;

 private:
  static constexpr int kSide = 128;
  static std::size_t IndexOf(const Eigen::Vector2d& place);
  void Vote(const PlacedEcho& echo, int change);
  int Around(const Eigen::Vector2d& place) const;

  std::vector<std::int16_t> cells_;
};

}  // namespace priamos::robot
