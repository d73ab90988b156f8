#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "head/core/scene/scene_object.hpp"
#include "test/bench/vision/scene/scene_looks.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::bench {

/// One glance of an approach.
struct TableLook {
  std::array<GreyImage, 3> images;
  std::array<head::CameraModel, 3> calibrated;
  Pose2 map_from_base;
  double gap_m = 0;  ///< from the front of the base to the nearest part of the table
};

/// A base that comes towards a table, and glances ahead as the head does.
struct TableApproach {
  std::vector<TableLook> looks;
  std::vector<world::Solid> solids;  ///< all of the world, map frame
  world::BoxPlan table;
  bool is_square = false, has_table = false;

  /// Whether something solid is within `near_m` of all of the front of what was told, at its height.
  bool IsReal(const head::SceneObject& object, const Pose2& map_from_base, double near_m) const;
  /// How far, at most, the side of the table that is nearest to a place is from the front that was told.
  bool IsOfTable(const head::SceneObject& object, const Pose2& map_from_base, double near_m) const;
};

/// Draws tables of any size, on legs at their corners, on inset ones, or hanging, met squarely and obliquely,
/// in made-up rooms and floors; in every fourth room there is none.
class TablePhotographer {
 public:
  TablePhotographer() : graphics_(world::Renderer::HoldGraphics()) {}
  TableApproach Take(std::uint64_t seed, const CalibratedHead& head);

 private:
  std::shared_ptr<void> graphics_;
};

}  // namespace priamos::bench
