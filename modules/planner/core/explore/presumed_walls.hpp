#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/archive.hpp"
#include "common/learned/learned_walls.hpp"

namespace priamos::planner {

/// Where walls go on although nobody told so.
struct PresumedWallConfig {
  double corner_m =
      0.75;  ///< so much of either wall may be missing to a corner: through less the base does not fit
  double passed_m =
      1.8;  ///< who drives past the end of a wall so near hears an edge there, if it is one; if not ...
  double told_m = 2.0;     ///< ... once it has driven so much farther, for an edge is told a while after ...
  double heard_m = 2.5;    ///< ... the wall goes on, so far at most, to a corner that was heard ...
  double unheard_m = 1.8;  ///< ... or so far to another wall

  void Describe(Archive& a);
};

/// The pieces that are missing between walls that were told. A wall is told as far as the base heard it:
/// never all the way into the corner of a room, and not where it drove past too fast or at a slant. But an
/// opening has edges, which are heard: where the base, whose middle was at the places of `trail`, drove past
/// the end of a wall and heard none, the wall goes on to the corner, or to the next piece on its line.
std::vector<LearnedWall> PresumedWalls(const LearnedWalls& walls, const std::vector<Eigen::Vector2d>& trail,
                                       const PresumedWallConfig& config);

}  // namespace priamos::planner
