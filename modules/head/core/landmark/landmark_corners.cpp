#include "head/core/landmark/landmark_corners.hpp"

namespace priamos::head {

std::optional<Meeting> MeetingOf(const LandmarkEdge& a, const LandmarkEdge& b, double reach_m) {
  constexpr double kMinTurn = 0.3;  // sine of the angle between neighbours
  for (const bool a_at_from : {true, false}) {
    for (const bool b_at_from : {true, false}) {
      const Eigen::Vector3d &p = a_at_from ? a.from : a.to, &q = b_at_from ? b.from : b.to;
      if ((p - q).squaredNorm() > reach_m * reach_m) continue;
      const Eigen::Vector3d u = a.to - a.from, v = b.to - b.from;
      if (u.cross(v).norm() < kMinTurn * u.norm() * v.norm()) return std::nullopt;
      return Meeting{a_at_from, b_at_from};
    }
  }
  return std::nullopt;
}

}  // namespace priamos::head
