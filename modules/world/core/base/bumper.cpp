#include "world/core/base/bumper.hpp"

#include <algorithm>

#include "world/core/scene/outline.hpp"

namespace priamos::world {
namespace {

/// The halves of the four sides, counter-clockwise from the left half of the front.
std::vector<Rectangle> Segments(const Eigen::Vector2d& footprint_m) {
  const double x = footprint_m.x() / 2, y = footprint_m.y() / 2;
  const Eigen::Vector2d across(0, y / 2), along(x / 2, 0);
  return {{{x, y / 2, 0}, across},  {{x / 2, y, 0}, along},    {{-x / 2, y, 0}, along},
          {{-x, y / 2, 0}, across}, {{-x, -y / 2, 0}, across}, {{-x / 2, -y, 0}, along},
          {{x / 2, -y, 0}, along},  {{x, -y / 2, 0}, across}};
}

}  // namespace

void BumperConfig::Describe(Archive& a) {
  a.Number("low_m", low_m, {"m", 0, 2, "lower edge of the strip"});
  a.Number("high_m", high_m, {"m", 0, 2, "upper edge of the strip"});
  if (high_m < low_m) a.Refuse("high_m", "at least low_m");
  a.Number("travel_m", travel_m, {"m", 0.0001, 0.02, "pressed when a solid is nearer than this"});
}

Bumper::Bumper(const BumperConfig& config, const Eigen::Vector2d& footprint_m,
               const std::vector<Solid>& solids)
    : travel_m_(config.travel_m), segments_(Segments(footprint_m)) {
  for (std::size_t i = 0; i < solids.size(); ++i) {
    if (!Overlaps(solids[i], config.low_m, config.high_m)) continue;
    outlines_.push_back(OutlineOf(solids[i]));
    solids_.push_back(i);
  }
}

void Bumper::Move(const MovedSolid& moved) {
  const auto it = std::find(solids_.begin(), solids_.end(), moved.solid);
  if (it == solids_.end()) return;  // at another height
  outlines_[static_cast<std::size_t>(it - solids_.begin())].map_from_centre = moved.map_from_solid;
}

std::uint8_t Bumper::Pressed(const Pose2& map_from_base) const {
  unsigned pressed = 0;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Rectangle segment{map_from_base * segments_[i].map_from_centre, segments_[i].half_m};
    if (std::any_of(outlines_.begin(), outlines_.end(),
                    [&](const Rectangle& outline) { return Distance(segment, outline) < travel_m_; }))
      pressed |= 1U << i;
  }
  return static_cast<std::uint8_t>(pressed);
}

}  // namespace priamos::world
