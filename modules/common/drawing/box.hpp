#pragma once

#include <Eigen/Core>

namespace priamos::drawing {

/// An upright rectangle of a page [px]; x right, y down, the corner with the smallest numbers first.
struct Box {
  double x = 0, y = 0, width = 0, height = 0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
  Eigen::Vector2d middle() const { return {x + width / 2, y + height / 2}; }
  /// Whether two boxes overlap; boxes that only touch do not.
  bool Overlaps(const Box& other) const {
    return x < other.right() && other.x < right() && y < other.bottom() && other.y < bottom();
  }
  bool Holds(const Box& other) const {
    return other.x >= x && other.right() <= right() && other.y >= y && other.bottom() <= bottom();
  }
  bool Holds(const Eigen::Vector2d& point) const {
    return point.x() >= x && point.x() <= right() && point.y() >= y && point.y() <= bottom();
  }
  /// Larger by `margin` on every side; smaller if it is negative.
  Box Grown(double margin) const { return {x - margin, y - margin, width + 2 * margin, height + 2 * margin}; }
};

}  // namespace priamos::drawing
