#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/rectangle.hpp"
#include "common/robot/body_size.hpp"
#include "world/core/scene/moved_solid.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::world {

/// The body that can touch things: a rectangle around the base centre between two heights.
struct Body {
  Eigen::Vector2d size_m{kDrawnBody.length_m, kDrawnBody.width_m};  ///< length (x), width (y)
  double low_m = 0.02;                  ///< lower solids are rolled over: a door threshold
  double high_m = kDrawnBody.height_m;  ///< top of the robot
};

/// Exact distances between the robot's footprint and the solids at its height.
class Clearance {
 public:
  /// Copies what it needs; solids below or above the body are left out, and those that `counts` does not
  /// want.
  Clearance(const Body& body, const std::vector<Solid>& solids,
            const std::function<bool(std::size_t)>& counts = {});

  /// Distance from the footprint at `pose` to the nearest solid, at most `limit_m`; 0 in contact.
  double Gap(const Pose2& pose, double limit_m) const;
  /// Share of the motion from `from` to `to` (0 to 1) on which the footprint stays free; `from` counts as
  /// free.
  double FreePart(const Pose2& from, const Pose2& to) const;
  /// A solid is elsewhere now.
  void Move(const MovedSolid& moved);
  /// The solid nearest to the footprint at `pose`, by its place in the list, and its outline; none when there
  /// is none at the robot's height.
  struct Neighbour {
    std::size_t solid;
    Rectangle outline;
    double gap_m;
  };
  std::optional<Neighbour> Nearest(const Pose2& pose) const;

 private:
  struct Obstacle {
    Rectangle outline;
    double radius_m;    ///< radius of the circle around it
    std::size_t solid;  ///< its place in the list
  };

  Body body_;
  std::vector<Obstacle> obstacles_;
};

/// Counts touches: a touch begins when the gap falls below `begin_m` and ends when it rises above `end_m`,
/// so that scraping along a wall is one touch.
class ContactCounter {
 public:
  ContactCounter(double begin_m, double end_m) : begin_m_(begin_m), end_m_(end_m) {}

  void Update(double gap_m);
  int contacts() const { return contacts_; }
  /// Smallest gap ever given [m]; infinity before the first.
  double min_gap_m() const { return min_gap_m_; }

 private:
  double begin_m_, end_m_;
  bool touching_ = false;
  int contacts_ = 0;
  double min_gap_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace priamos::world
