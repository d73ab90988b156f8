#include "head/core/landmark/other_breadth.hpp"

#include <algorithm>

#include "head/core/landmark/edge_association.hpp"

namespace priamos::head {
namespace {

constexpr int kLeft = 1, kRight = 2;  // LandmarkEdge::side
constexpr double kFrom_m = 0.04, kTo_m = 0.2, kStep_m = 0.01;

/// With one side farther outwards; what belongs to both sides ends there.
LandmarkModel WithSideOut(const LandmarkModel& model, int side, double out_m) {
  LandmarkModel other = model;
  const double by_m = side == kLeft ? out_m : -out_m;
  for (LandmarkEdge& edge : other.edges)
    for (Eigen::Vector3d* end : {&edge.from, &edge.to}) {
      const bool ends_there = edge.side == 0 && (end->y() > 0) == (side == kLeft);
      if (edge.side == side || ends_there) end->y() += by_m;
    }
  return other;
}

}  // namespace

double LeadOfOtherBreadth(const LandmarkModel& seen, std::span<const int> visible,
                          std::span<const CameraView> views, const Eigen::Isometry3d& base_from_landmark,
                          const AssociationOptions& options) {
  const auto odds = [&](const LandmarkModel& model) {
    return Associate(model, visible, views, base_from_landmark, options).log_odds;
  };
  double best = -1e9;
  for (const int side : {kLeft, kRight})
    for (double by_m = kFrom_m; by_m <= kTo_m; by_m += kStep_m)
      for (const double out_m : {by_m, -by_m}) best = std::max(best, odds(WithSideOut(seen, side, out_m)));
  return best - odds(seen);
}

}  // namespace priamos::head
