#include "head/core/motion/aim_tilt.hpp"

#include <cmath>
#include <optional>

namespace priamos::head {
namespace {

const double kTiltStep_rad = Radians(0.5);
constexpr double kAsHigh_m = 0.02;  ///< edges that much below the highest one belong to it

/// The middle of the highest level edges, base frame; nullopt: there is none to be seen from the base.
std::optional<Eigen::Vector3d> Top(const LandmarkModel& model, const Pose2& base_from_landmark) {
  const Eigen::Vector2d viewer = base_from_landmark.Inverse().translation();
  const LandmarkEdge* top = nullptr;
  for (const LandmarkEdge& edge : model.edges)
    if (edge.IsLevel() && edge.IsSeenFrom(viewer) && (!top || edge.from.z() > top->from.z() + kAsHigh_m))
      top = &edge;
  if (!top) return std::nullopt;
  return Lift(base_from_landmark) * Eigen::Vector3d((top->from + top->to) / 2);
}

/// Whether both pictures of a setting show a point below their upper border.
bool BothShow(const HeadModel& head, const HeadSetting& setting, const Eigen::Vector3d& point,
              double margin_px) {
  for (const int camera : {kLeft, kRight}) {
    const auto model = head.CameraAt(setting, camera);
    if (!model || !(model->Depth(point) > 0.1) || model->Project(point).y() < margin_px) return false;
  }
  return true;
}

}  // namespace

void TiltConfig::Describe(Archive& a) {
  a.Number("most_deg", most_deg, {"deg", 0, 45, "a look is tilted up no farther than this"});
  a.Number("margin_px", margin_px, {"px", 0, 250, "edges nearer to the upper border are not in the picture"});
}

double AimTilt(const HeadModel& head, const HeadSetting& base, const LandmarkModel& model,
               const Pose2& base_from_landmark, const TiltConfig& config) {
  const auto top = Top(model, base_from_landmark);
  if (!top) return base.tilt_rad;
  HeadSetting setting = base;
  setting.pan_rad = std::atan2(top->y() - head.geometry.y_m, top->x() - head.geometry.x_m);
  for (; setting.tilt_rad >= -Radians(config.most_deg); setting.tilt_rad -= kTiltStep_rad)
    if (BothShow(head, setting, *top, config.margin_px)) return setting.tilt_rad;
  return base.tilt_rad;
}

}  // namespace priamos::head
