#include "world/core/base/contact.hpp"

#include <algorithm>

#include "world/core/scene/outline.hpp"

namespace priamos::world {

Clearance::Clearance(const Body& body, const std::vector<Solid>& solids,
                     const std::function<bool(std::size_t)>& counts)
    : body_(body) {
  for (std::size_t i = 0; i < solids.size(); ++i) {
    if (counts && !counts(i)) continue;
    if (!Overlaps(solids[i], body.low_m, body.high_m)) continue;
    const Rectangle outline = OutlineOf(solids[i]);
    obstacles_.push_back({outline, outline.half_m.norm(), i});
  }
}

void Clearance::Move(const MovedSolid& moved) {
  const auto it = std::find_if(obstacles_.begin(), obstacles_.end(),
                               [&](const Obstacle& obstacle) { return obstacle.solid == moved.solid; });
  if (it != obstacles_.end()) it->outline.map_from_centre = moved.map_from_solid;
}

std::optional<Clearance::Neighbour> Clearance::Nearest(const Pose2& pose) const {
  const Rectangle footprint{pose, body_.size_m / 2};
  std::optional<Neighbour> nearest;
  for (const Obstacle& obstacle : obstacles_) {
    const double gap_m = Distance(footprint, obstacle.outline);
    if (!nearest || gap_m < nearest->gap_m) nearest = Neighbour{obstacle.solid, obstacle.outline, gap_m};
  }
  return nearest;
}

double Clearance::Gap(const Pose2& pose, double limit_m) const {
  const Rectangle footprint{pose, body_.size_m / 2};
  const double radius_m = footprint.half_m.norm();
  double nearest = limit_m;
  for (const auto& [outline, outline_radius_m, solid] : obstacles_) {
    // Two lower bounds that are cheaper than the distance: circle to circle, then circle to rectangle.
    const Eigen::Vector2d apart = outline.map_from_centre.translation() - pose.translation();
    if (apart.norm() - outline_radius_m - radius_m >= nearest) continue;
    if (Distance(outline, pose.translation()) - radius_m >= nearest) continue;
    nearest = std::min(nearest, Distance(footprint, outline));
  }
  return nearest;
}

double Clearance::FreePart(const Pose2& from, const Pose2& to) const {
  const auto free = [&](double part) {
    const Pose2 pose{from.x + part * (to.x - from.x), from.y + part * (to.y - from.y),
                     from.yaw + part * WrapAngle(to.yaw - from.yaw)};
    return Gap(pose, 0.001) > 0;
  };
  if (free(1)) return 1;
  double low = 0, high = 1;
  // 2^-10 of a step of millimetres is far below anything that is reported.
  for (int i = 0; i < 10; ++i) (free((low + high) / 2) ? low : high) = (low + high) / 2;
  return low;
}

void ContactCounter::Update(double gap_m) {
  min_gap_m_ = std::min(min_gap_m_, gap_m);
  if (!touching_ && gap_m < begin_m_) {
    touching_ = true;
    ++contacts_;
  } else if (touching_ && gap_m > end_m_) {
    touching_ = false;
  }
}

}  // namespace priamos::world
