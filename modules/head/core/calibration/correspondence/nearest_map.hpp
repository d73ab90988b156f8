#pragma once

#include <algorithm>
#include <vector>

#include "head/core/calibration/discs/disc_fit.hpp"

namespace priamos::head {

/// Which detection is nearest to a place: the candidate of a 16-pixel cell.
class NearestMap {
 public:
  explicit NearestMap(const std::vector<DetectedDisc>& discs);
  /// -1 far from all detections.
  int operator()(const Eigen::Vector2d& px) const {
    const Eigen::Vector2d d = px - low_;
    if (!(d.x() > -kMargin && d.y() > -kMargin)) return -1;
    if (!(d.x() < columns_ * kCell + kMargin && d.y() < rows_ * kCell + kMargin)) return -1;
    const int column = std::clamp(Cell(d.x()), 0, columns_ - 1);
    const int row = std::clamp(Cell(d.y()), 0, rows_ - 1);
    return nearest_[static_cast<std::size_t>(row) * columns_ + column];
  }

 private:
  static constexpr double kCell = 16, kMargin = 48;
  static int Cell(double distance) { return static_cast<int>(distance / kCell); }

  void Fill(const std::vector<DetectedDisc>& discs, int column, int row);

  Eigen::Vector2d low_{1e9, 1e9}, high_{-1e9, -1e9};
  int columns_, rows_;
  std::vector<int> nearest_;
};

}  // namespace priamos::head
