#include "planner/core/map/box_skeleton.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

constexpr int kSteps = 180;            ///< azimuths, 2 degrees apart
constexpr int kPoints = 9;             ///< along an edge
constexpr double kTouching_m = 0.001;  ///< a ray that only touches a box is not stopped by it
constexpr double kOnFloor_m = 0.05;

/// Whether the line of sight from `eye` to `point` passes through the box: in its own frame, slab by slab.
bool Hides(const LandmarkBox& box, const Eigen::Vector3d& eye, const Eigen::Vector3d& point) {
  const Pose2 inverse = box.landmark_from_box.Inverse();
  const Eigen::Vector2d a2 = inverse * Eigen::Vector2d(eye.head<2>()),
                        b2 = inverse * Eigen::Vector2d(point.head<2>());
  const Eigen::Vector3d a(a2.x(), a2.y(), eye.z()),
      ray(b2.x() - a2.x(), b2.y() - a2.y(), point.z() - eye.z());
  const Eigen::Vector3d low(-box.size_m.x() / 2, -box.size_m.y() / 2, box.z_min_m),
      high(box.size_m.x() / 2, box.size_m.y() / 2, box.z_max_m);
  double begin = 0, end = 1;
  for (int k = 0; k < 3; ++k) {
    const double from = low[k] + kTouching_m - a[k], to = high[k] - kTouching_m - a[k];
    if (std::abs(ray[k]) < 1e-12) {
      if (from > 0 || to < 0) return false;
      continue;
    }
    begin = std::max(begin, std::min(from / ray[k], to / ray[k]));
    end = std::min(end, std::max(from / ray[k], to / ray[k]));
  }
  return begin < end;
}

/// Share of the edge that an eye sees.
double Share(std::span<const LandmarkBox> boxes, const LandmarkEdge& edge, const Eigen::Vector3d& eye) {
  int seen = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector3d point = edge.from + (i + 0.5) / kPoints * (edge.to - edge.from);
    seen += std::none_of(boxes.begin(), boxes.end(),
                         [&](const LandmarkBox& box) { return Hides(box, eye, point); });
  }
  return double(seen) / kPoints;
}

double AzimuthOf(int step) {
  return WrapAngle(2 * kPi * step / kSteps);
}

bool IsSeen(std::span<const LandmarkBox> boxes, const LandmarkEdge& edge, int step, const Viewers& viewers) {
  const double azimuth = AzimuthOf(step);
  const LandmarkEdge sector{{}, {}, viewers.from_rad, viewers.to_rad, Side::kBoth};
  if (!IsVisible(sector, {std::cos(azimuth), std::sin(azimuth)})) return false;
  return std::all_of(viewers.distances_m.begin(), viewers.distances_m.end(), [&](double distance) {
    const Eigen::Vector3d eye(distance * std::cos(azimuth), distance * std::sin(azimuth), viewers.eye_m);
    return Share(boxes, edge, eye) >= viewers.min_visible;
  });
}

/// Sets the largest sector; false if it is too small to be of use.
bool FindSector(std::span<const LandmarkBox> boxes, const Viewers& viewers, LandmarkEdge& edge) {
  std::vector<bool> seen(kSteps);
  for (int i = 0; i < kSteps; ++i) seen[i] = IsSeen(boxes, edge, i, viewers);
  int best = 0, best_begin = 0;
  for (int begin = 0; begin < kSteps; ++begin) {
    int length = 0;
    while (length < kSteps && seen[(begin + length) % kSteps]) ++length;
    if (length > best) {
      best = length;
      best_begin = begin;
    }
  }
  if ((best - 1) * 2 * kPi / kSteps < viewers.min_sector_rad) return false;
  const bool everywhere = best == kSteps;
  edge.visible_from_rad = everywhere ? -kPi : AzimuthOf(best_begin);
  edge.visible_to_rad = everywhere ? kPi : AzimuthOf(best_begin + best - 1);
  return true;
}

/// The twelve edges of a box.
std::vector<LandmarkEdge> EdgesOf(const LandmarkBox& box) {
  std::vector<Eigen::Vector2d> corners;
  for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}})
    corners.push_back(box.landmark_from_box * Eigen::Vector2d(x * box.size_m.x(), y * box.size_m.y()));
  std::vector<LandmarkEdge> edges;
  const auto add = [&](const Eigen::Vector2d& a, double za, const Eigen::Vector2d& b, double zb) {
    edges.push_back({{a.x(), a.y(), za}, {b.x(), b.y(), zb}, 0, 0, box.side});
  };
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % 4];
    add(a, box.z_min_m, a, box.z_max_m);
    add(a, box.z_max_m, b, box.z_max_m);
    if (box.z_min_m > kOnFloor_m) add(a, box.z_min_m, b, box.z_min_m);
  }
  return edges;
}

}  // namespace

std::vector<LandmarkEdge> SkeletonOf(std::span<const LandmarkBox> boxes, const Viewers& viewers) {
  std::vector<LandmarkEdge> skeleton;
  for (const LandmarkBox& box : boxes) {
    if (!box.has_edges) continue;
    for (LandmarkEdge& edge : EdgesOf(box))
      if (FindSector(boxes, viewers, edge)) skeleton.push_back(edge);
  }
  return skeleton;
}

}  // namespace priamos::planner
