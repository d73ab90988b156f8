#include "head/core/doors/leaf_shape.hpp"

#include <algorithm>
#include <cmath>

#include "common/cross.hpp"

namespace priamos::head {
namespace {

/// Cuts [from, to] to where `value(t) = at0 + t * (at1 - at0)` is positive.
void CutToPositive(double at0, double at1, double& from, double& to) {
  if (at0 < 0 && at1 < 0) to = from - 1;
  if ((at0 < 0) == (at1 < 0)) return;
  const double t = at0 / (at0 - at1);
  (at0 < 0 ? from : to) = at0 < 0 ? std::max(from, t) : std::min(to, t);
}

}  // namespace

LeafAt::LeafAt(const DoorPlan& door, const char* hinge, double open_rad, double thickness_m) {
  const LeafShape leaf = LeafOf(door, hinge, Degrees(open_rad), thickness_m);
  // The pin is on the side y > 0 of a left-hand leaf's own frame: its free end on the other.
  const double free = std::string_view(hinge) == "left" ? -1 : 1;
  const double x = leaf.size_m.x() / 2, y = leaf.size_m.y() / 2;
  const std::array<Eigen::Vector2d, 4> own{Eigen::Vector2d(-x, free * y), Eigen::Vector2d(x, free * y),
                                           Eigen::Vector2d(x, -free * y), Eigen::Vector2d(-x, -free * y)};
  for (int i = 0; i < 4; ++i) corner_[i] = leaf.door_from_leaf * own[i];
  turn_ = -free;
  low_m_ = leaf.z_min_m;
  high_m_ = leaf.z_max_m;
}

bool LeafAt::Faces(int side, const Eigen::Vector2d& viewer) const {
  const Eigen::Vector2d& a = corner_[side];
  return turn_ * Cross(corner_[(side + 1) % 4] - a, viewer - a) < 0;
}

std::vector<DoorEdge> LeafAt::FreeEdges(const Eigen::Vector2d& viewer) const {
  std::vector<DoorEdge> edges;
  for (int i = 0; i < 2; ++i)
    if (Faces(0, viewer) || Faces(i == 0 ? 3 : 1, viewer))
      edges.push_back({{corner_[i].x(), corner_[i].y(), high_m_}, {corner_[i].x(), corner_[i].y(), low_m_}});
  return edges;
}

std::vector<DoorEdge> LeafAt::UpperEdges(const Eigen::Vector2d& viewer) const {
  std::vector<DoorEdge> edges;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d &a = corner_[i], &b = corner_[3 - i];
    if (Faces(i == 0 ? 3 : 1, viewer)) edges.push_back({{a.x(), a.y(), high_m_}, {b.x(), b.y(), high_m_}});
  }
  return edges;
}

bool LeafAt::Hides(const Eigen::Vector2d& viewer, const Eigen::Vector2d& point, double clear_m) const {
  const Eigen::Vector2d middle_free = (corner_[0] + corner_[1]) / 2,
                        middle_hinge = (corner_[2] + corner_[3]) / 2;
  const Eigen::Vector2d along = middle_hinge - middle_free, sight = point - viewer;
  const double det = Cross(sight, along);
  if (std::abs(det) < 1e-6) return false;
  const double at = Cross(middle_free - viewer, along) / det;  // share of the sight where it meets the leaf
  const double where = Cross(middle_free - viewer, sight) / det;
  const double border = clear_m / along.norm();
  return at > 0 && (1 - at) * sight.norm() > clear_m && where > border && where < 1 - border;
}

std::optional<DoorEdge> ThroughOpening(const DoorPlan& door, const Eigen::Vector3d& viewer,
                                       const DoorEdge& edge) {
  const double half = door.opening_width_m / 2;
  double from = 0, to = 1;
  for (const double x : {door.FrontX(), door.StopX()}) {
    // A sight passes the plane at x within |y| < half and z < height: linear in the point, times its depth.
    const double ahead = x - viewer.x();
    if (ahead <= 0) continue;
    const auto margin = [&](const Eigen::Vector3d& p) {
      const double depth = p.x() - viewer.x();
      const Eigen::Vector3d side = viewer * depth + (p - viewer) * ahead;
      return std::array<double, 3>{half * depth - side.y(), half * depth + side.y(),
                                   door.opening_height_m * depth - side.z()};
    };
    const auto a = margin(edge.from), b = margin(edge.to);
    for (int i = 0; i < 3; ++i) CutToPositive(a[i], b[i], from, to);
  }
  if (to - from < 1e-6) return std::nullopt;
  const Eigen::Vector3d along = edge.to - edge.from;
  return DoorEdge{edge.from + from * along, edge.from + to * along};
}

}  // namespace priamos::head
