#include "head/core/floor/line_geometry.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double kMinSine = 0.02;  ///< sine of the smallest angle between line of sight and plane of light
constexpr double kSpan_m = 3;      ///< to either side, where the floor's line is looked for
constexpr double kRowMargin_px = 14;

bool IsBefore(const CameraModel& camera, const Vector3d& at) {
  return at.allFinite() && at.x() >= kNearestLight_m && at.x() <= kFarthestLight_m && camera.Depth(at) >= 0.1;
}

}  // namespace

Triangulation::Triangulation(const CameraModel& camera, const LaserPlane& laser)
    : camera_(camera),
      normal_(laser.normal),
      ray_from_image_(camera.image_from_base.leftCols<3>().inverse()),
      eye_(-ray_from_image_ * camera.image_from_base.col(3)),
      distance_(laser.normal.dot(eye_) + laser.offset_m) {}

std::optional<Triangulation::Point> Triangulation::At(const Vector2d& image_px) const {
  const Vector3d ray = ray_from_image_ * camera_.Undistort(image_px).homogeneous();
  const double slope = normal_.dot(ray), range = -distance_ / slope;
  if (!(std::abs(slope) > kMinSine * ray.norm()) || !(range > 0)) return std::nullopt;
  const Vector3d by_row = ray_from_image_.col(1);
  const Vector3d moved = range * (by_row - ray * (normal_.dot(by_row) / slope));
  return Point{eye_ + range * ray, moved.z(), ray.z() / slope};
}

FloorLine::FloorLine(const CameraModel& camera, const LaserPlane& laser, const Vector3d& plane) {
  const Vector3d& n = laser.normal;
  for (double y = kSpan_m; y >= -kSpan_m; y -= 0.05) {
    // n.(x, y, z) + offset = 0 with z = a + b x + c y.
    const double x =
        -(n.y() * y + n.z() * (plane[0] + plane[2] * y) + laser.offset_m) / (n.x() + n.z() * plane[1]);
    const Vector3d at(x, y, plane.dot(Vector3d(1, x, y)));
    if (!IsBefore(camera, at)) continue;
    const Vector2d px = camera.Distort(camera.Project(at));
    if (columns_.empty() || px.x() > columns_.back().first) columns_.push_back({px.x(), {px.y(), at}});
  }
}

std::optional<FloorLine::Point> FloorLine::At(double column) const {
  const auto after = std::lower_bound(columns_.begin(), columns_.end(), column,
                                      [](const auto& c, double value) { return c.first < value; });
  if (after == columns_.begin() || after == columns_.end()) return std::nullopt;
  const auto& [left, a] = *(after - 1);
  const auto& [right, b] = *after;
  const double share = (column - left) / (right - left);
  return Point{a.row + share * (b.row - a.row), a.at + share * (b.at - a.at)};
}

RowRange LineRows(const CameraModel& camera, const LaserPlane& laser, const ImageSize& picture,
                  const ObstacleOptions& options) {
  double first = 1e9, last = -1e9;
  for (int step = 0; step <= 10; ++step) {
    const double z = options.lowest_m + step / 10.0 * (options.highest_m - options.lowest_m);
    for (double y = -kSpan_m; y <= kSpan_m; y += 0.25) {
      const Vector3d& n = laser.normal;
      const Vector3d at(-(n.y() * y + n.z() * z + laser.offset_m) / n.x(), y, z);
      if (!IsBefore(camera, at)) continue;
      const Vector2d image = camera.Project(at);
      if (image.x() < -0.1 * picture.width || image.x() > 1.1 * picture.width) continue;
      const double row = camera.Distort(image).y();
      if (row < -0.5 * picture.height || row > 1.5 * picture.height) continue;
      first = std::min(first, row);
      last = std::max(last, row);
    }
  }
  const RowRange rows{static_cast<int>(std::max(0.0, first - kRowMargin_px)),
                      static_cast<int>(std::min<double>(picture.height - 1, last + kRowMargin_px))};
  return rows.first < rows.last ? rows : RowRange{};
}

}  // namespace priamos::head
