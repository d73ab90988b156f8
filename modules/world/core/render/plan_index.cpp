#include "world/core/render/plan_index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace priamos::world {

PlanIndex::PlanIndex(const std::vector<Disc>& discs) {
  Eigen::AlignedBox2d box;
  for (const Disc& disc : discs)
    if (disc.radius_m <= kCell_m) box.extend(disc.centre);
  if (!box.isEmpty()) {
    low_ = box.min();
    size_ = CellOf(box.max()) + Eigen::Vector2i::Ones();
  }
  cells_.resize(std::size_t(size_.x()) * std::size_t(size_.y()));
  for (std::size_t i = 0; i < discs.size(); ++i)
    (discs[i].radius_m <= kCell_m ? cells_[IndexOf(CellOf(discs[i].centre))] : large_).push_back(i);
}

/// Also of places outside, as far as numbers reach.
Eigen::Vector2i PlanIndex::CellOf(const Eigen::Vector2d& place) const {
  constexpr double kMost = 1e6;
  return ((place - low_) / kCell_m).array().floor().cwiseMax(-kMost).cwiseMin(kMost).cast<int>();
}

}  // namespace priamos::world
