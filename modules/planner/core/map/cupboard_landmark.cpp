#include "planner/core/map/cupboard_landmark.hpp"

#include <array>
#include <cmath>

#include "planner/core/map/box_skeleton.hpp"

namespace priamos::planner {
namespace {

/// Lines on the front are seen under no flatter angle than this.
constexpr double kGrazingFront_rad = Radians(20);
constexpr double kBeforeFront_rad = kPi / 2 + kGrazingFront_rad;

LandmarkEdge OnFront(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return {from, to, kBeforeFront_rad, -kBeforeFront_rad, Side::kBoth};
}

Side SideOf(const LandmarkEdge& edge, double half_m) {
  const bool left = edge.from.y() > 0.9 * half_m && edge.to.y() > 0.9 * half_m;
  const bool right = edge.from.y() < -0.9 * half_m && edge.to.y() < -0.9 * half_m;
  return left ? Side::kLeft : right ? Side::kRight : Side::kBoth;
}

void AddGaps(const CupboardPlan& cupboard, std::vector<LandmarkEdge>& edges) {
  const double width = cupboard.width_m / cupboard.n_doors;
  for (int i = 1; i < cupboard.n_doors; ++i) {
    const double middle = cupboard.width_m / 2 - i * width;
    for (const double side : {0.5, -0.5}) {
      const double y = middle + side * cupboard.gap_m;
      edges.push_back(OnFront({0, y, cupboard.plinth_m}, {0, y, cupboard.height_m}));
    }
  }
}

}  // namespace

Landmark MakeCupboardLandmark(const CupboardPlan& cupboard) {
  const double half = cupboard.width_m / 2;
  const LandmarkBox box{{cupboard.depth_m / 2, 0, 0},
                        {cupboard.depth_m, cupboard.width_m},
                        0,
                        cupboard.height_m,
                        true,
                        Side::kBoth};
  Landmark landmark{cupboard.id, cupboard.map_from_cupboard(), SkeletonOf(std::array{box})};
  for (LandmarkEdge& edge : landmark.edges) edge.side = SideOf(edge, half);
  if (cupboard.plinth_m > 0) {
    landmark.edges.push_back(OnFront({0, -half, cupboard.plinth_m}, {0, half, cupboard.plinth_m}));
    // It runs to the left: the doors are right of it.
    if (cupboard.plinth_over_front > 0)
      landmark.edges.back().grey_ratio = -std::log(cupboard.plinth_over_front);
  }
  AddGaps(cupboard, landmark.edges);
  return landmark;
}

}  // namespace priamos::planner
