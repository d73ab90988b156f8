#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "common/frame_store.hpp"
#include "head/core/calibration/discs/disc_projection.hpp"

namespace priamos::head {

inline constexpr double kRimReach_px = 2.5;  ///< beyond the half-level rim: where a sharp rim has faded
inline constexpr double kPixelVariance = 1.0 / 12;  ///< variance of light spread over a pixel [px^2]

/// Grown in proportion, by `px` at the mean of both semi-axes.
Ellipse Grown(const Ellipse& ellipse, double px);

/// Pixels from (u0, v0) to (u1, v1), both included.
struct Box {
  int u0, u1, v0, v1;
};

/// The pixels of the ellipse's bounding box; nullopt if it leaves the image.
std::optional<Box> BoundingBox(const GreyImage& image, const Ellipse& e);

/// Whether a pixel lies within the ellipse.
inline bool Within(const Ellipse& e, double u, double v) {
  const Eigen::Vector2d d = Eigen::Vector2d(u, v) - e.centre_px;
  const Eigen::Matrix2d& m = e.shape_px2;
  const double det = m.determinant();
  return m(1, 1) * d.x() * d.x() - 2 * m(0, 1) * d.x() * d.y() + m(0, 0) * d.y() * d.y() < det;
}

/// Calls visit(offset from the centre, q^2, grey value) for every pixel within the ellipse (q^2 <= 1) that
/// is not within one of the others.
template <class Visit>
void ForEachPixel(const GreyImage& image, const Box& box, const Ellipse& e, std::span<const Ellipse> others,
                  const Visit& visit) {
  const Eigen::Matrix2d k = e.shape_px2.inverse();
  for (int v = box.v0; v <= box.v1; ++v) {
    const std::uint8_t* row = image.pixels.data() + static_cast<std::size_t>(v) * image.width;
    const double dy = v - e.centre_px.y();
    for (int u = box.u0; u <= box.u1; ++u) {
      const double dx = u - e.centre_px.x();
      const double q2 = k(0, 0) * dx * dx + 2 * k(0, 1) * dx * dy + k(1, 1) * dy * dy;
      if (q2 > 1) continue;
      const auto hides = [&](const Ellipse& other) { return Within(other, u, v); };
      if (std::any_of(others.begin(), others.end(), hides)) continue;
      visit(dx, dy, q2, row[u]);
    }
  }
}

}  // namespace priamos::head
