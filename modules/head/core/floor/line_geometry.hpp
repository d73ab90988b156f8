#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "common/image_size.hpp"
#include "head/core/camera/camera_model.hpp"
#include "head/core/camera/laser_plane.hpp"
#include "head/core/floor/obstacle_options.hpp"

namespace priamos::head {

/// Where lines of sight of a camera meet the plane of a laser's light.
class Triangulation {
 public:
  Triangulation(const CameraModel& camera, const LaserPlane& laser);

  /// A point of the light in the base frame [m].
  struct Point {
    Eigen::Vector3d at;
    double rise_m_per_px;   ///< change of its height with the row
    double rise_per_shift;  ///< and with a shift of the plane along its normal
  };
  /// nullopt where the plane is seen edge-on, or lies behind the camera.
  std::optional<Point> At(const Eigen::Vector2d& image_px) const;

 private:
  const CameraModel& camera_;
  Eigen::Vector3d normal_;
  Eigen::Matrix3d ray_from_image_;
  Eigen::Vector3d eye_;
  double distance_;
};

/// Where the light meets a floor z = plane.dot(1, x, y) of the base frame, by column of the picture.
class FloorLine {
 public:
  FloorLine(const CameraModel& camera, const LaserPlane& laser,
            const Eigen::Vector3d& plane = Eigen::Vector3d::Zero());

  /// A point of the line: row [distorted px], and place [m].
  struct Point {
    double row;
    Eigen::Vector3d at;
  };
  std::optional<Point> At(double column) const;

 private:
  std::vector<std::pair<double, Point>> columns_;  ///< by ascending column
};

/// Rows of a picture in which a line can lie, for floors between lowest and highest; first > last: none, the
/// camera does not see it.
struct RowRange {
  int first = 0, last = -1;
};
RowRange LineRows(const CameraModel& camera, const LaserPlane& laser, const ImageSize& picture,
                  const ObstacleOptions& options);

}  // namespace priamos::head
