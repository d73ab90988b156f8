#include "head/core/scene/face_sights.hpp"

#include <cmath>

#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

constexpr double kBorder_m = 0.03;   ///< edges nearer to the border of the face may belong to it
constexpr double kLeastShare = 0.2;  ///< of the face's height in the image, seen behind it: less is an outlier

/// Where a point of space is, seen against a face.
struct Sight {
  bool inside = false;   ///< it appears within the face
  double behind_m = 0;   ///< distance from its plane, away from the camera
  double sigma_m = 0;    ///< of that distance
};

Sight SightOf(const FacePlane& face, const Eigen::Vector3d& eye, const SpaceEdge& edge) {
  const Eigen::Vector3d middle = (edge.from + edge.to) / 2;
  const double width = (face.to - face.from).norm();
  const Eigen::Vector2d along = (face.to - face.from) / width;
  Eigen::Vector2d away(-along.y(), along.x());
  if (away.dot(face.from - eye.head<2>()) < 0) away = -away;
  const double eye_m = away.dot(face.from - eye.head<2>());  // from the plane
  Sight sight;
  sight.behind_m = away.dot(middle.head<2>() - face.from);
  const Eigen::Matrix2d covariance =
      (edge.covariance.block<2, 2>(0, 0) + edge.covariance.block<2, 2>(3, 3)) / 4 +
      (edge.covariance.block<2, 2>(0, 3) + edge.covariance.block<2, 2>(3, 0)) / 4;
  sight.sigma_m = std::sqrt(std::max(0.0, away.dot(covariance * away)));
  const double share = eye_m / std::max(1e-3, eye_m + sight.behind_m);
  const Eigen::Vector3d at = eye + share * (middle - eye);
  const double s = along.dot(at.head<2>() - face.from);
  sight.inside = eye_m > 0 && s > kBorder_m && s < width - kBorder_m && at.z() > face.bottom_m + kBorder_m &&
                 at.z() < face.top_m - kBorder_m;
  return sight;
}

}  // namespace

bool IsSeenThrough(const FacePlane& face, const CameraView& left, std::span<const StereoMatch> matches,
                   double behind_m) {
  const Eigen::Vector3d eye = OpticalCentre(*left.camera);
  double behind_px = 0, on_px = 0;
  for (const StereoMatch& match : matches) {
    if (!match.space) continue;
    const Sight sight = SightOf(face, eye, *match.space);
    if (!sight.inside) continue;
    const double length_px = left.lines[match.left].length_px;
    if (sight.behind_m > behind_m + 3 * sight.sigma_m)
      behind_px += length_px;
    else if (std::abs(sight.behind_m) < behind_m / 2 + 3 * sight.sigma_m)
      on_px += length_px;
  }
  const Eigen::Vector2d middle = (face.from + face.to) / 2;
  const double height_px = (left.camera->Project({middle.x(), middle.y(), face.top_m}) -
                            left.camera->Project({middle.x(), middle.y(), face.bottom_m}))
                               .norm();
  return behind_px > on_px + kLeastShare * height_px;
}

}  // namespace priamos::head
