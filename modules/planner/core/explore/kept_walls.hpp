#pragma once

#include <map>
#include <vector>

#include "common/learned/learned_walls.hpp"
#include "planner/core/map/wall_faces.hpp"

namespace priamos::planner {

/// Walls as they were when the base had left them for the first time. The robot's pose drifts, and what it
/// tells later drifts with it; a base that comes back finds its pose by what was mapped first.
class KeptWalls {
 public:
  void Reset() { kept_.clear(); }
  /// Keeps what is worth it of the walls, edges left out, as they are known at `now_s` (since 1970): long and
  /// known well, not heard for a while, and not one that is kept already.
  void Learn(const LearnedWalls& walls, double now_s);
  /// The kept walls, each with the standard deviation of its ends.
  std::vector<WallFace> Faces() const;

 private:
  bool Has(const WallFace& face) const;

  std::map<int, WallFace> kept_;  ///< by the number of the learned wall
};

}  // namespace priamos::planner
