#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "common/ground_plan.hpp"

namespace priamos::head {

/// A straight edge of space, door frame [m].
struct DoorEdge {
  Eigen::Vector3d from, to;
};

/// The leaf of a door at some angle, door frame [m].
class LeafAt {
 public:
  /// `hinge` as in LeafOf().
  LeafAt(const DoorPlan& door, const char* hinge, double open_rad, double thickness_m);

  /// Upright arrises of the free end: that of the face which closes the opening, and that of the other face.
  std::array<Eigen::Vector2d, 2> FreeEnds() const { return {corner_[0], corner_[1]}; }
  /// Free arrises from the top downwards, and upper edges from the free end to the hinges, of the faces that
  /// `viewer` sees.
  std::vector<DoorEdge> FreeEdges(const Eigen::Vector2d& viewer) const;
  std::vector<DoorEdge> UpperEdges(const Eigen::Vector2d& viewer) const;
  /// Whether the leaf stands between `viewer` and `point`, more than `clear_m` before it.
  bool Hides(const Eigen::Vector2d& viewer, const Eigen::Vector2d& point, double clear_m) const;

 private:
  /// Whether the side from corner i to corner i + 1 faces the viewer.
  bool Faces(int side, const Eigen::Vector2d& viewer) const;
  std::array<Eigen::Vector2d, 4> corner_;  ///< free end, first two; then the hinged end, around
  double low_m_, high_m_, turn_;
};

/// The part of an edge that a viewer before the door sees through its opening; nullopt: nothing.
std::optional<DoorEdge> ThroughOpening(const DoorPlan& door, const Eigen::Vector3d& viewer,
                                       const DoorEdge& edge);

}  // namespace priamos::head
