#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/rectangle.hpp"

namespace priamos::planner {

/// What a base met that does not know where it is, frame of the way: things that stopped it, and what it
/// heard close by in its direction of driving. Neither has to be a wall, and no way leads through it.
class MetThings {
 public:
  void Reset();
  /// Something stopped the base.
  void OnStop(const Rectangle& thing) { stops_.push_back(thing); }
  /// The nearest echo in the direction of driving; one that is far away says little of where it is.
  void OnEcho(const Eigen::Vector2d& at, double free_m);

  const std::vector<Rectangle>& stops() const { return stops_; }
  /// Squares around the echoes, but those that the base has driven over since: nothing is there.
  std::vector<Rectangle> Echoes(const std::vector<Pose2>& trail) const;

 private:
  std::vector<Rectangle> stops_;
  std::vector<Eigen::Vector2d> echoes_;
};

}  // namespace priamos::planner
