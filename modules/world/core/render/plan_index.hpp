#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace priamos::world {

/// Finds bodies by their place on the floor: a world from a map of a building has thousands, of which few are
/// near any place.
class PlanIndex {
 public:
  /// A body, as a disc around it [m].
  struct Disc {
    Eigen::Vector2d centre{0, 0};
    double radius_m = 0;
  };

  PlanIndex() = default;
  explicit PlanIndex(const std::vector<Disc>& discs);

  /// Calls `visit` with the number of each disc that may reach to within `reach_m` of a place, and of some
  /// more; once for each, in no order.
  template <class Visit>
  void VisitNear(const Eigen::Vector2d& place, double reach_m, const Visit& visit) const {
    for (const std::size_t disc : large_) visit(disc);
    const Eigen::Vector2d around = Eigen::Vector2d::Constant(reach_m + kCell_m);
    const Eigen::Vector2i low = CellOf(place - around).cwiseMax(0);
    const Eigen::Vector2i high = CellOf(place + around).cwiseMin(size_ - Eigen::Vector2i::Ones());
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x)
        for (const std::size_t disc : cells_[IndexOf({x, y})]) visit(disc);
  }

 private:
  static constexpr double kCell_m = 2;  ///< discs of a larger radius are visited always

  Eigen::Vector2i CellOf(const Eigen::Vector2d& place) const;
  std::size_t IndexOf(const Eigen::Vector2i& cell) const {
    return std::size_t(cell.y()) * std::size_t(size_.x()) + std::size_t(cell.x());
  }

  Eigen::Vector2d low_{0, 0};
  Eigen::Vector2i size_{0, 0};
  std::vector<std::vector<std::size_t>> cells_;  ///< the discs whose centres are there
  std::vector<std::size_t> large_;
};

}  // namespace priamos::world
