#include "world/core/motion/swinging_leaf.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::world {

SwingingLeaf::SwingingLeaf(MovedLeaf leaf, const Solid& solid)
    : leaf_(std::move(leaf)), half_m_(solid.size_m / 2), open_deg_(0) {
  open_deg_ = std::abs(Degrees(WrapAngle(solid.map_from_solid.yaw - PoseAt(0).yaw)));
}

Pose2 SwingingLeaf::PoseAt(double open_deg) const {
  return leaf_.door.map_from_door() *
         LeafOf(leaf_.door, leaf_.hinge, open_deg, leaf_.thickness_m).door_from_leaf;
}

void SwingingLeaf::Step(double since_start_s, double dt_s, const Rectangle& robot) {
  const LeafSwing* now = nullptr;
  for (const LeafSwing& swing : leaf_.swings)
    if (swing.at_s <= since_start_s && (!now || swing.at_s >= now->at_s)) now = &swing;
  if (!now || now->to_deg == open_deg_) return;
  const double most = now->speed_deg_s * dt_s, turn = std::clamp(now->to_deg - open_deg_, -most, most);
  const auto against = [&](double part) {
    return Distance(Rectangle{PoseAt(open_deg_ + part * turn), half_m_}, robot) <= 0;
  };
  double free = 1;
  if (against(1)) {
    double blocked = 1;
    free = 0;
    for (int i = 0; i < 7; ++i) (against((free + blocked) / 2) ? blocked : free) = (free + blocked) / 2;
  }
  open_deg_ += free * turn;
}

}  // namespace priamos::world
