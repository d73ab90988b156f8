#include "head/core/scene/face_sights.hpp"

#include <cmath>

#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

constexpr double kBorder_m = 0.03;  ///< edges nearer to the border of the face may belong to it
constexpr double kLeastShare =
    0.2;  ///< of the face's height in the image, seen behind it: less is an outlier

/// A face as a camera sees it.
class SeenFace {
 public:
  SeenFace(const FacePlane& face, const Eigen::Vector3d& eye)
      : face_(face), eye_(eye), width_((face.to - face.from).norm()), along_((face.to - face.from) / width_) {
    away_ = {-along_.y(), along_.x()};
    if (away_.dot(face.from - eye.head<2>()) < 0) away_ = -away_;
    eye_m_ = away_.dot(face.from - eye.head<2>());
  }

  /// Unit vector on the floor, square to it and away from the camera.
  const Eigen::Vector2d& away() const { return away_; }
  /// How far a point lies behind its plane [m].
  double Behind(const Eigen::Vector3d& at) const { return away_.dot(at.head<2>() - face_.from); }
  /// Whether a point appears within it, at least `border_m` from its border.
  bool Shows(const Eigen::Vector3d& point, double border_m) const {
    const double share = eye_m_ / std::max(1e-3, eye_m_ + Behind(point));
    const Eigen::Vector3d at = eye_ + share * (point - eye_);
    const double s = along_.dot(at.head<2>() - face_.from);
    return eye_m_ > 0 && s > border_m && s < width_ - border_m && at.z() > face_.bottom_m + border_m &&
           at.z() < face_.top_m - border_m;
  }

 private:
  FacePlane face_;
  Eigen::Vector3d eye_;
  double width_;
  Eigen::Vector2d along_, away_;
  double eye_m_ = 0;  ///< distance of the camera from the plane
};

}  // namespace

bool IsSeenThrough(const FacePlane& face, const CameraModel& left, std::span<const SceneEdge> edges,
                   double behind_m) {
  const SeenFace seen(face, OpticalCentre(left));
  double behind_px = 0, on_px = 0;
  for (const SceneEdge& edge : edges) {
    if (!seen.Shows(edge.middle, kBorder_m)) continue;
    const double behind = seen.Behind(edge.middle);
    const double sigma = std::sqrt(seen.away().dot(edge.covariance * seen.away()));
    if (behind > behind_m + 3 * sigma)
      behind_px += edge.length_px;
    else if (std::abs(behind) < behind_m / 2 + 3 * sigma)
      on_px += edge.length_px;
  }
  const Eigen::Vector2d middle = (face.from + face.to) / 2;
  const double height_px = (left.Project({middle.x(), middle.y(), face.top_m}) -
                            left.Project({middle.x(), middle.y(), face.bottom_m}))
                               .norm();
  return behind_px > on_px + kLeastShare * height_px;
}

double Overlap(const FacePlane& face, const FacePlane& other, const CameraModel& left) {
  constexpr int kSteps = 8;
  const SeenFace seen(other, OpticalCentre(left));
  int within = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Eigen::Vector2d at = face.from + (i + 0.5) / kSteps * (face.to - face.from);
      const double z = face.bottom_m + (j + 0.5) / kSteps * (face.top_m - face.bottom_m);
      within += seen.Shows({at.x(), at.y(), z}, 0);
    }
  }
  return static_cast<double>(within) / (kSteps * kSteps);
}

}  // namespace priamos::head
