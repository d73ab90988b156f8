#include "head/core/calibration/correspondence/nearest_map.hpp"

#include <limits>

namespace priamos::head {

using Eigen::Vector2d;

NearestMap::NearestMap(const std::vector<DetectedDisc>& discs) {
  for (const DetectedDisc& d : discs) {
    low_ = low_.cwiseMin(d.ellipse.centre_px);
    high_ = high_.cwiseMax(d.ellipse.centre_px);
  }
  columns_ = Cell(high_.x() - low_.x()) + 1;
  rows_ = Cell(high_.y() - low_.y()) + 1;
  nearest_.resize(static_cast<std::size_t>(columns_) * rows_);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) Fill(discs, column, row);
  }
}

void NearestMap::Fill(const std::vector<DetectedDisc>& discs, int column, int row) {
  const Vector2d centre = low_ + kCell * Vector2d(column + 0.5, row + 0.5);
  double best = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const double distance = (discs[i].ellipse.centre_px - centre).squaredNorm();
    if (distance >= best) continue;
    best = distance;
    nearest_[static_cast<std::size_t>(row) * columns_ + column] = static_cast<int>(i);
  }
}

}  // namespace priamos::head
