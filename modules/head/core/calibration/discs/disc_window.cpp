#include "head/core/calibration/discs/disc_window.hpp"

namespace priamos::head {

Ellipse Grown(const Ellipse& ellipse, double px) {
  const double scale = 1 + px / std::max(0.5, std::sqrt(ellipse.SemiMajor() * ellipse.SemiMinor()));
  return {ellipse.centre_px, ellipse.shape_px2 * scale * scale};
}

std::optional<Box> BoundingBox(const GreyImage& image, const Ellipse& e) {
  const double du = std::sqrt(e.shape_px2(0, 0)), dv = std::sqrt(e.shape_px2(1, 1));
  const Eigen::Vector2d& c = e.centre_px;
  const bool inside =
      c.x() - du >= 0 && c.x() + du <= image.width - 1 && c.y() - dv >= 0 && c.y() + dv <= image.height - 1;
  if (!inside) return std::nullopt;  // also when anything is NaN
  return Box{static_cast<int>(std::ceil(c.x() - du)), static_cast<int>(c.x() + du),
             static_cast<int>(std::ceil(c.y() - dv)), static_cast<int>(c.y() + dv)};
}

}  // namespace priamos::head
