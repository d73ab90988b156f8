#include "world/core/scene/holes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace priamos::world {
namespace {

constexpr double kSteep = 1e-9;  ///< a ray that climbs or falls less than this is level

/// Distance to a plane across axis `i` at `at`; infinite when the ray does not come nearer to it.
double ToPlane(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, int i, double at) {
  const double t = direction[i] == 0 ? -1 : (at - origin[i]) / direction[i];
  return t > 0 ? t : std::numeric_limits<double>::infinity();
}

/// The side or the bottom that a ray within a hole meets; none when it leaves through the top.
std::optional<FloorHit> CastWithin(const HolePlan& hole, int index, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) {
  const Eigen::Vector3d low(hole.x_m - hole.length_m / 2, hole.y_m - hole.width_m / 2, -hole.depth_m);
  const Eigen::Vector3d high(hole.x_m + hole.length_m / 2, hole.y_m + hole.width_m / 2, 0);
  FloorHit hit{std::numeric_limits<double>::infinity(), Eigen::Vector3d::Zero(), index};
  bool through_top = false;
  for (int i = 0; i < 3; ++i) {
    const double t = ToPlane(origin, direction, i, direction[i] > 0 ? high[i] : low[i]);
    if (t >= hit.distance_m) continue;
    hit.distance_m = t;
    hit.normal = direction[i] > 0 ? Eigen::Vector3d(-Eigen::Vector3d::Unit(i))
                                  : Eigen::Vector3d(Eigen::Vector3d::Unit(i));
    through_top = i == 2 && direction[i] > 0;
  }
  if (through_top || !std::isfinite(hit.distance_m)) return std::nullopt;
  return hit;
}

}  // namespace

void HolePlan::Describe(Archive& a) {
  NotePlace(a, place);
  a.Text("name", name, "for messages");
  a.Number("x_m", x_m, {"m", -100, 100, "map, middle"});
  a.Number("y_m", y_m, {"m", -100, 100, "map, middle"});
  a.Number("length_m", length_m, {"m", 0.05, 50, "along x of the map"});
  a.Number("width_m", width_m, {"m", 0.05, 50, "along y of the map"});
  a.Number("depth_m", depth_m, {"m", 0.02, 5, "how far the floor is lower there"});
}

bool HolePlan::Contains(const Eigen::Vector2d& in_map) const {
  return std::abs(in_map.x() - x_m) < length_m / 2 && std::abs(in_map.y() - y_m) < width_m / 2;
}

const HolePlan* HoleAt(const std::vector<HolePlan>& holes, const Eigen::Vector2d& in_map) {
  const auto it =
      std::find_if(holes.begin(), holes.end(), [&](const HolePlan& hole) { return hole.Contains(in_map); });
  return it == holes.end() ? nullptr : &*it;
}

std::optional<FloorHit> CastToFloor(const std::vector<HolePlan>& holes, const Eigen::Vector3d& origin,
                                    const Eigen::Vector3d& direction) {
  Eigen::Vector3d from = origin;
  double before_m = 0;
  if (origin.z() >= 0) {
    if (direction.z() >= -kSteep) return std::nullopt;
    before_m = -origin.z() / direction.z();
    from = origin + before_m * direction;
    from.z() = 0;
  }
  const HolePlan* hole = HoleAt(holes, from.head<2>());
  if (!hole) {
    if (origin.z() < 0) return std::nullopt;
    return FloorHit{before_m, Eigen::Vector3d::UnitZ(), -1};
  }
  auto hit = CastWithin(*hole, static_cast<int>(hole - holes.data()), from, direction);
  if (hit) hit->distance_m += before_m;
  return hit;
}

std::vector<FloorPiece> FloorAround(const std::vector<HolePlan>& holes, const FloorPiece& floor) {
  std::vector<FloorPiece> pieces{floor};
  for (const HolePlan& hole : holes) {
    const Eigen::Vector2d half(hole.length_m / 2, hole.width_m / 2), middle(hole.x_m, hole.y_m);
    const Eigen::Vector2d low = middle - half, high = middle + half;
    std::vector<FloorPiece> rest;
    const auto keep = [&rest](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      if (a.x() < b.x() && a.y() < b.y()) rest.push_back({a, b});
    };
    for (const FloorPiece& p : pieces) {
      const Eigen::Vector2d inner_low = p.low.cwiseMax(low), inner_high = p.high.cwiseMin(high);
      if (inner_low.x() >= inner_high.x() || inner_low.y() >= inner_high.y()) {
        rest.push_back(p);
        continue;
      }
      keep(p.low, {inner_low.x(), p.high.y()});
      keep({inner_high.x(), p.low.y()}, p.high);
      keep({inner_low.x(), p.low.y()}, {inner_high.x(), inner_low.y()});
      keep({inner_low.x(), inner_high.y()}, {inner_high.x(), p.high.y()});
    }
    pieces = rest;
  }
  return pieces;
}

}  // namespace priamos::world
