#include "planner/core/graph/anchored_objects.hpp"

#include <utility>

namespace priamos::planner {
namespace {

bool IsSame(const LearnedObject& a, const LearnedObject& b) {
  return a.kind == b.kind && a.looks == b.looks && a.seen_s == b.seen_s && a.x_m == b.x_m && a.y_m == b.y_m;
}

}  // namespace

bool AnchoredObjects::Take(const std::vector<LearnedObject>& told, const FloorGraph& graph) {
  std::map<int, Anchored> now;
  bool changed = told.size() != objects_.size();
  for (const LearnedObject& object : told) {
    const auto known = objects_.find(object.id);
    const bool stays = known != objects_.end() && IsSame(known->second.told, object);
    changed = changed || !stays;
    now[object.id] = stays
                         ? known->second
                         : Anchored{object, graph.AnchorOf(graph.map_from_robot() * object.map_from_front())};
  }
  objects_ = std::move(now);
  return changed;
}

std::vector<LearnedObject> AnchoredObjects::At(const FloorGraph& graph) const {
  std::vector<LearnedObject> objects;
  for (const auto& [id, anchored] : objects_) {
    const Pose2 front = graph.PlaceOf(anchored.front);
    objects.push_back(anchored.told);
    objects.back().x_m = front.x;
    objects.back().y_m = front.y;
    objects.back().yaw_deg = Degrees(front.yaw);
  }
  return objects;
}

}  // namespace priamos::planner
