#include "planner/core/door_landmark.hpp"

#include <cmath>

namespace priamos::planner {
namespace {

/// From where a door is looked at; sectors of edges in the depth of the wall are exact for this distance.
constexpr double kViewingDistanceM = 2.5;
/// How far inside the line of a jamb a viewer must stand for its depth to be seen as two separate edges: at
/// the viewing distance the two arrises of a 12 cm deep jamb are then about 4 of 768 pixels apart.
constexpr double kJambViewM = 0.2;
/// Faces seen under a flatter angle than this give no usable edge.
constexpr double kGrazingRad = Radians(15);

struct Sector {
  double from_rad, to_rad;
};

/// Everybody before the wall.
constexpr Sector kApproachSide{kPi / 2 + kGrazingRad, -kPi / 2 - kGrazingRad};

/// Viewers who see the depth of the left jamb: not from behind its face, not through the right jamb.
Sector LeftJambSector(const DoorPlan& door) {
  const double half_m = door.opening_width_m / 2;
  const double behind_face = std::atan2(half_m - kJambViewM, kViewingDistanceM);
  const double past_right_jamb = std::atan2(door.opening_width_m, door.StopX() - door.FrontX());
  return {WrapAngle(kPi - behind_face), WrapAngle(kPi + past_right_jamb - kGrazingRad)};
}

/// The same edge at y and mirrored at -y; the sector is mirrored with it.
void AddJambEdge(std::vector<LandmarkEdge>& edges, double x, double y, double height, const Sector& sector) {
  edges.push_back({{x, y, 0}, {x, y, height}, sector.from_rad, sector.to_rad, Side::kLeft});
  edges.push_back({{x, -y, 0}, {x, -y, height}, -sector.to_rad, -sector.from_rad, Side::kRight});
}

void AddLintelEdge(std::vector<LandmarkEdge>& edges, double x, double half_width, double z) {
  edges.push_back(
      {{x, -half_width, z}, {x, half_width, z}, kApproachSide.from_rad, kApproachSide.to_rad, Side::kBoth});
}

}  // namespace

Landmark MakeDoorLandmark(const DoorPlan& door) {
  const double half = door.opening_width_m / 2, outer = half + door.frame_width_m;
  const double top = door.opening_height_m, outer_top = top + door.frame_width_m;
  Landmark landmark{door.id, door.map_from_door(), {}};
  auto& edges = landmark.edges;
  AddJambEdge(edges, door.FrontX(), outer, outer_top, kApproachSide);
  AddJambEdge(edges, door.FrontX(), half, top, kApproachSide);
  AddJambEdge(edges, door.StopX(), half, top, LeftJambSector(door));
  AddLintelEdge(edges, door.FrontX(), outer, outer_top);
  AddLintelEdge(edges, door.FrontX(), half, top);
  AddLintelEdge(edges, door.StopX(), half, top);
  return landmark;
}

bool IsVisible(const LandmarkEdge& edge, const Eigen::Vector2d& in_landmark) {
  const auto turn_from_begin = [&edge](double rad) {
    const double turn = std::fmod(rad - edge.visible_from_rad, 2 * kPi);
    return turn < 0 ? turn + 2 * kPi : turn;
  };
  const double azimuth = std::atan2(in_landmark.y(), in_landmark.x());
  return turn_from_begin(azimuth) <= turn_from_begin(edge.visible_to_rad);
}

}  // namespace priamos::planner
