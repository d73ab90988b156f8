#pragma once

#include <Eigen/Core>

namespace priamos {

/// Twice the area of the triangle 0, a, b; positive when b is left of a.
inline double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace priamos
