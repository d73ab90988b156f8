#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "common/archive.hpp"
#include "common/frame_store.hpp"
#include "head/core/camera/camera_model.hpp"
#include "head/core/camera/laser_plane.hpp"
#include "head/core/floor/laser_stripe.hpp"

namespace priamos::head {

/// Standard deviations of the floor's pose in the base frame, and of its measurement: a robot pitches and
/// rolls on its wheels.
struct FloorTolerance {
  double heave_m = 0.002;  ///< height below the robot, joints and ramps included
  double pitch_rad = 0.002, roll_rad = 0.002;
  double rough_m = 0.001;   ///< roughness of the surface, from place to place
  double camera_px = 0.15;  ///< error of the third camera's calibration and of its motors

  void Describe(Archive& a);
};

/// What counts as an obstacle; heights above the floor [m].
struct ObstacleOptions {
  FloorTolerance floor;
  double min_height_m = 0.015;              ///< lower obstacles are driven over
  double lowest_m = -0.5, highest_m = 0.5;  ///< range of heights that is searched, above the floor
  double significance = 5;                  ///< sigmas of the height that an obstacle needs
  int min_columns = 12;                     ///< columns of the picture that an obstacle needs
  int min_missing = 40;                     ///< a gap in the line is reported if it has more columns
  double min_seen = 0.3;  ///< share of columns with a line; with less the floor is not judged

  void Describe(Archive& a);
};

/// A straight piece of the laser's line that is not on the floor, in the base frame; the kinds are those of
/// obstacle_segment_t.
struct ObstaclePiece {
  /// Kind of deviation from the floor.
  enum Kind {
    kUp = 0,      ///< something stands there
    kDown = 1,    ///< the floor drops
    kMissing = 2  ///< no line; the ends are where the floor would show it
  };
  Kind kind = kUp;
  Eigen::Vector3d right, left;              ///< ends [m]
  double height_m = 0, sigma_height_m = 0;  ///< mean over the piece, above the floor
};

/// The floor in one picture of the line; the verdicts are those of obstacle_line_t.
struct ObstacleLines {
  /// Verdict on the floor ahead; kBlind: too little of the line was seen to judge the floor.
  enum Verdict { kClear = 0, kObstacle = 1, kBlind = 2 };
  Verdict verdict = kBlind;
  double seen_share = 0;              ///< columns with a line
  std::vector<ObstaclePiece> pieces;  ///< from right to left
  /// The estimated floor: z = floor.dot(1, x, y) in the base frame, and the covariance of these numbers.
  Eigen::Vector3d floor = Eigen::Vector3d::Zero();
  Eigen::Matrix3d floor_covariance = Eigen::Matrix3d::Zero();
};

/// Obstacles from the points of the line: every point is triangulated with the plane of light; the floor is
/// the plane that explains most of the points within its tolerance (as a robust maximum a posteriori); what
/// stands out from it over several neighbouring columns, by more than all errors together allow, is an
/// obstacle. `width` is that of the picture [px].
ObstacleLines FindObstacles(std::span<const StripePoint> points, int width, const CameraModel& camera,
                            const LaserPlane& laser, const ObstacleOptions& options);

/// Finds the line in a picture and the obstacles on it. Only rows in which the line can lie are searched.
class ObstacleFinder {
 public:
  explicit ObstacleFinder(const ObstacleOptions& options = {}, const StripeOptions& stripe = {})
      : options_(options), stripe_(stripe) {}
  ObstacleLines Find(const GreyImage& picture, const CameraModel& camera, const LaserPlane& laser);

 private:
  ObstacleOptions options_;
  StripeFinder stripe_;
  GreyImage band_;
};

/// Rows of a picture in which the line can lie, for floors between lowest and highest; first > last: none,
/// the camera does not see it.
struct RowRange {
  int first = 0, last = -1;
};
RowRange LineRows(const CameraModel& camera, const LaserPlane& laser, int width, int height,
                  const ObstacleOptions& options);

}  // namespace priamos::head
