#include "head/core/scene/box_depth.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "head/core/camera/projection.hpp"
#include "head/core/stereo/plan_line.hpp"

namespace priamos::head {
namespace {

/// Where the line of sight through an image point meets the plane at height `z`, front frame.
class Ground {
 public:
  Ground(const CameraView& view, const Pose2& base_from_front, double z)
      : eye_(OpticalCentre(*view.camera)),
        ray_from_image_(view.camera->image_from_base.leftCols<3>().inverse()),
        front_from_base_(base_from_front.Inverse()),
        z_(z) {}

  Eigen::Vector2d operator()(const Eigen::Vector2d& image) const {
    const Eigen::Vector3d ray = ray_from_image_ * image.homogeneous();
    const Eigen::Vector3d at = eye_ + ray * ((z_ - eye_.z()) / ray.z());
    return front_from_base_ * Eigen::Vector2d(at.head<2>());
  }

 private:
  Eigen::Vector3d eye_;
  Eigen::Matrix3d ray_from_image_;
  Pose2 front_from_base_;
  double z_;
};

/// The longest level edge that leads away from a corner of the front (its y), as one image shows it; 0: none.
double LengthIn(const CameraView& view, const Ground& ground, double corner_y, const DepthOptions& options) {
  double longest = 0;
  for (const ViewLine& line : view.lines) {
    if (!IsLevel(line)) continue;
    Eigen::Vector2d from = ground(line.p), to = ground(line.q);
    if (from.x() > to.x()) std::swap(from, to);
    const double near = std::abs(from.x()) + std::abs(from.y() - corner_y);
    const double turn = std::abs(std::atan2(to.y() - from.y(), to.x() - from.x()));
    if (near > 2 * options.corner_m || turn > options.square_rad) continue;
    longest = std::max(longest, to.x());
  }
  return longest;
}

}  // namespace

std::optional<double> DepthBehind(const StereoViews& views, const Pose2& base_from_front, double width_m,
                                  double top_m, const DepthOptions& options) {
  if (top_m > OpticalCentre(*views[0].camera).z() - options.below_eye_m) return std::nullopt;
  const Ground left(views[0], base_from_front, top_m), right(views[1], base_from_front, top_m);
  std::optional<double> best;
  for (const double corner_y : {-width_m / 2, width_m / 2}) {
    const double a = LengthIn(views[0], left, corner_y, options),
                 b = LengthIn(views[1], right, corner_y, options);
    const double depth = (a + b) / 2;
    if (depth < options.min_depth_m || depth > options.max_depth_m) continue;
    if (std::abs(a - b) > options.same_m + options.same_share * depth) continue;
    if (!best || depth > *best) best = depth;
  }
  return best;
}

}  // namespace priamos::head
