#include "head/core/doors/model_door.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace priamos::head {
namespace {

/// Coordinates of a model have steps of 2 mm on the radio.
constexpr double kSame_m = 0.004;

std::vector<const LandmarkEdge*> Uprights(const LandmarkModel& model, int side) {
  std::vector<const LandmarkEdge*> uprights;
  for (const LandmarkEdge& edge : model.edges)
    if (edge.side == side && edge.IsVertical()) uprights.push_back(&edge);
  return uprights;
}

/// The arris of the stop: the deepest upright of a side.
const LandmarkEdge* Deepest(const std::vector<const LandmarkEdge*>& uprights) {
  const auto deepest = std::max_element(uprights.begin(), uprights.end(),
                                        [](auto* a, auto* b) { return a->from.x() < b->from.x(); });
  return deepest == uprights.end() ? nullptr : *deepest;
}

/// The arris of the front before `stop`, if there is a frame outside of both.
const LandmarkEdge* FrontOf(const LandmarkEdge& stop, const std::vector<const LandmarkEdge*>& uprights) {
  const double half = std::abs(stop.from.y());
  const LandmarkEdge* front = nullptr;
  bool framed = false;
  for (const LandmarkEdge* edge : uprights) {
    const double beside = std::abs(edge->from.y()) - half;
    if (beside > 2 * kSame_m) framed = true;
    if (std::abs(beside) < kSame_m && edge->from.x() < stop.from.x() - 2 * kSame_m) front = edge;
  }
  return framed ? front : nullptr;
}

}  // namespace

std::optional<DoorPlan> DoorOf(const LandmarkModel& model) {
  const auto left = Uprights(model, 1), right = Uprights(model, 2);
  const LandmarkEdge *left_stop = Deepest(left), *right_stop = Deepest(right);
  if (!left_stop || !right_stop) return std::nullopt;
  const LandmarkEdge* front = FrontOf(*left_stop, left);
  if (!front || !FrontOf(*right_stop, right)) return std::nullopt;
  DoorPlan door;
  door.id = model.id;
  door.opening_width_m = left_stop->from.y() - right_stop->from.y();
  door.opening_height_m = std::max(left_stop->from.z(), left_stop->to.z());
  // The landmark's origin is half way through the wall.
  door.wall_thickness_m = 2 * (left_stop->from.x() + door.rebate_depth_m);
  door.frame_protrusion_m = -door.wall_thickness_m / 2 - front->from.x();
  if (door.opening_width_m < 0.3 || door.opening_height_m < 1) return std::nullopt;
  return door;
}

}  // namespace priamos::head
