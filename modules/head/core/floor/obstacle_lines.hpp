#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "common/frame_store.hpp"
#include "head/core/camera/camera_model.hpp"
#include "head/core/camera/laser_plane.hpp"
#include "head/core/floor/laser_stripe.hpp"
#include "head/core/floor/line_order.hpp"
#include "head/core/floor/obstacle_options.hpp"

namespace priamos::head {

/// A straight piece of a laser's line that is not on the floor, in the base frame; the kinds are those of
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
  int laser = 0;                            ///< whose line it is, as in the calibration
};

/// The floor in one picture of the lines; the verdicts are those of obstacle_line_t.
struct ObstacleLines {
  /// Verdict on the floor ahead; kBlind: too little of the lines was seen to judge the floor.
  enum Verdict { kClear = 0, kObstacle = 1, kBlind = 2 };
  Verdict verdict = kBlind;
  double seen_share = 0;              ///< columns with a line, of all lines in the picture
  std::vector<ObstaclePiece> pieces;  ///< from right to left
  /// The estimated floor: z = floor.dot(1, x, y) in the base frame, and the covariance of these numbers.
  Eigen::Vector3d floor = Eigen::Vector3d::Zero();
  Eigen::Matrix3d floor_covariance = Eigen::Matrix3d::Zero();
};

/// The line of one laser in a picture.
struct SeenLine {
  LaserPlane plane;
  ExpectedLine expected;
  std::vector<StripePoint> points;  ///< by ascending column
};

/// Obstacles from the points of the lines: every point is triangulated with its plane of light; the floor is
/// the plane that explains most of the points within its tolerance (as a robust maximum a posteriori); what
/// stands out from it over several neighbouring columns, by more than all errors together allow, is an
/// obstacle. How the robot nods moves all lines in one known way, so a step across all of one line shows
/// against the other; of a single line it is known only against the tolerance.
ObstacleLines FindObstacles(std::span<const SeenLine> lines, const CameraModel& camera,
                            const ObstacleOptions& options);

/// Finds the lines in a picture and the obstacles on them. Only rows in which lines can lie are searched.
class ObstacleFinder {
 public:
  explicit ObstacleFinder(const ObstacleOptions& options = {}, const StripeOptions& stripe = {})
      : options_(options), stripe_(stripe) {}
  ObstacleLines Find(const GreyImage& picture, const CameraModel& camera, std::span<const LaserPlane> lasers);

 private:
  std::vector<std::vector<StripePoint>> FindStripes(const GreyImage& picture,
                                                    std::span<const ExpectedLine> lines);

  ObstacleOptions options_;
  StripeFinder stripe_;
  GreyImage band_;
};

}  // namespace priamos::head
