#pragma once

#include <cstdint>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/rectangle.hpp"
#include "world/core/scene/moved_solid.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::world {

/// The rubber strip with contact switches around the base.
struct BumperConfig {
  double low_m = 0.03, high_m = 0.30;  ///< heights between which it feels
  double travel_m = 0.001;             ///< it is pressed when a solid is nearer than this

  void Describe(Archive& a);
};

/// Eight contact switches, one per half of each side of the footprint, counter-clockwise from the left half
/// of the front: bit 0 is the front's left half, bit 7 its right half, as in bumper_t.
class Bumper {
 public:
  static constexpr int kSegments = 8;

  /// Copies what it needs; solids below or above the strip are left out.
  Bumper(const BumperConfig& config, const Eigen::Vector2d& footprint_m, const std::vector<Solid>& solids);

  /// The switches that are pressed with the base at `map_from_base`.
  std::uint8_t Pressed(const Pose2& map_from_base) const;
  /// A solid is elsewhere now.
  void Move(const MovedSolid& moved);

 private:
  double travel_m_;
  std::vector<Rectangle> segments_;  ///< base frame
  std::vector<Rectangle> outlines_;  ///< map frame
  std::vector<std::size_t> solids_;  ///< whose they are
};

}  // namespace priamos::world
