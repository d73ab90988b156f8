#include "head/core/motion/aim_far.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/geometry.hpp"
#include "common/image_size.hpp"

namespace priamos::head {
namespace {

constexpr double kMostPan_rad = Radians(35), kPanStep_rad = Radians(2.5);
/// Nearer to the border an edge may be out of the picture by then.
constexpr double kShownMargin_px = 20;

/// An edge is expected at the height at which tilted cameras look at it.
bool IsShown(const HeadModel& head, const HeadSetting& setting, const UprightTarget& target) {
  const Eigen::Vector2d away = target.at - Eigen::Vector2d(head.geometry.x_m, head.geometry.y_m);
  const double height = std::clamp(head.geometry.z_m - away.norm() * std::tan(setting.tilt_rad),
                                   target.bottom_m, std::max(target.bottom_m, target.top_m));
  return std::ranges::all_of(std::array{kLeft, kRight}, [&](Camera camera) {
    const auto model = head.CameraAt(setting, camera);
    const Eigen::Vector3d point(target.at.x(), target.at.y(), height);
    if (!model || !(model->Depth(point) > 0)) return false;
    const Eigen::Array2d px = model->Project(point).array();
    const Eigen::Array2d size(ImageSize{}.width - 1, ImageSize{}.height - 1);
    return (px > kShownMargin_px).all() && (px < size - kShownMargin_px).all();
  });
}

}  // namespace

double AimFar(const HeadModel& head, const HeadSetting& base, std::span<const UprightTarget> targets) {
  double best_rad = 0;
  std::ptrdiff_t most = -1;
  for (int i = 0; i * kPanStep_rad <= kMostPan_rad; ++i) {
    for (const double pan_rad : {i * kPanStep_rad, -i * kPanStep_rad}) {
      HeadSetting setting = base;
      setting.pan_rad = pan_rad;
      const auto shown = std::ranges::count_if(
          targets, [&](const UprightTarget& target) { return IsShown(head, setting, target); });
      if (shown > most) {
        most = shown;
        best_rad = pan_rad;
      }
    }
  }
  return best_rad;
}

}  // namespace priamos::head
