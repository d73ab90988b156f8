#include "head/core/motion/aim.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "common/image_size.hpp"
#include "head/core/landmark/prediction.hpp"

namespace priamos::head {
namespace {

constexpr double kWidth_px = ImageSize{}.width, kHeight_px = ImageSize{}.height;
constexpr double kStep_rad = 0.005;
constexpr double kBehind_px = 1e6;  // outside of every picture

/// Where an upright edge is expected, at the height at which the cameras look at it: so it is in every
/// picture that shows its bearing.
struct Target {
  Eigen::Vector3d in_base;
  double bearing_sigma_rad;  ///< seen from the pan axis
};

Target TargetOf(const HeadGeometry& head, const LandmarkEdge& edge, const LandmarkPrediction& prediction,
                double tilt_rad) {
  Eigen::Vector3d p = Lift(prediction.base_from_landmark) * edge.from;
  const Eigen::Vector2d r = p.head<2>() - prediction.base_from_landmark.translation();
  const Eigen::Vector2d d = p.head<2>() - Eigen::Vector2d(head.x_m, head.y_m);
  const auto [low, high] = std::minmax(edge.from.z(), edge.to.z());
  p.z() = std::clamp(head.z_m - d.norm() * std::tan(tilt_rad), low, high);
  // The point moves with (x, y, yaw) of the landmark; what counts is its motion across the line of sight.
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << 1, 0, -r.y(), 0, 1, r.x();
  const Eigen::RowVector2d across(-d.y(), d.x());
  const Eigen::RowVector3d row = across * jacobian / d.squaredNorm();
  return {p, std::sqrt(std::max(0.0, (row * prediction.covariance * row.transpose()).value()))};
}

std::vector<Target> Targets(const HeadGeometry& head, const LandmarkModel& model,
                            const LandmarkPrediction& prediction, double tilt_rad,
                            bool (*wanted)(int edge_side, int side), int side) {
  std::vector<Target> targets;
  for (const LandmarkEdge& edge : model.edges) {
    if (!edge.IsVertical() || edge.IsMovable() || !wanted(edge.side, side)) continue;
    targets.push_back(TargetOf(head, edge, prediction, tilt_rad));
  }
  return targets;
}

double Beyond(double at_px, double margin_px, double size_px) {
  return std::max({0.0, margin_px - at_px, at_px - (size_px - 1 - margin_px)});
}

/// Largest distance of a target from the usable part of a picture [px]; 0 if all are in all pictures.
double Missing(std::span<const CameraModel> cameras, std::span<const Target> targets,
               const AimConfig& config) {
  double worst = 0;
  for (const CameraModel& camera : cameras) {
    for (const Target& t : targets) {
      if (!(camera.Depth(t.in_base) > 0.1)) return kBehind_px;
      const double margin = config.margin_px + config.sigmas * t.bearing_sigma_rad * camera.scale_px;
      worst = std::max(worst, Beyond(camera.Project(t.in_base).x(), margin, kWidth_px));
    }
  }
  return worst;
}

/// The same for a point of a level edge, which is seen at its height wherever it is along the edge.
double MissingInHeight(const CameraModel& camera, const Eigen::Vector3d& in_base,
                       const LandmarkPrediction& prediction, const AimConfig& config) {
  if (!(camera.Depth(in_base) > 0.1)) return kBehind_px;
  const Eigen::Matrix<double, 3, 6> pose = PoseJacobian(Lift(prediction.base_from_landmark), in_base);
  Eigen::Matrix3d floor;
  floor << pose.col(0), pose.col(1), pose.col(5);
  const Eigen::RowVector3d row = ProjectionJacobian(camera, in_base).row(1) * floor;
  const double sigma = std::sqrt(std::max(0.0, (row * prediction.covariance * row.transpose()).value()));
  return Beyond(camera.Project(in_base).y(), config.margin_px + config.sigmas * sigma, kHeight_px);
}

double Bearing(const HeadGeometry& head, const std::vector<Target>& targets) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Target& t : targets) mean += t.in_base.head<2>() / static_cast<double>(targets.size());
  return std::atan2(mean.y() - head.y_m, mean.x() - head.x_m);
}

std::optional<std::array<CameraModel, 2>> CamerasAt(const HeadModel& head, HeadSetting setting, double pan) {
  setting.pan_rad = pan;
  const auto left = head.CameraAt(setting, kLeft), right = head.CameraAt(setting, kRight);
  if (!left || !right) return std::nullopt;
  return std::array{*left, *right};
}

std::vector<Target> SideTargets(const HeadGeometry& head, const LandmarkModel& model,
                                const LandmarkPrediction& prediction, double tilt_rad, int side) {
  return Targets(
      head, model, prediction, tilt_rad, [](int edge, int s) { return s == 0 || edge == s; }, side);
}

/// As Missing, of the better one of both pictures.
double MissingInBetter(const std::array<CameraModel, 2>& cameras, std::span<const Target> targets,
                       const AimConfig& config) {
  const std::span<const CameraModel> both(cameras);
  return std::min(Missing(both.first(1), targets, config), Missing(both.last(1), targets, config));
}

}  // namespace

void AimConfig::Describe(Archive& a) {
  a.Number("side_share", side_share, {"-", 0, 1, "0 looks at the middle of the landmark, 1 at its side"});
  a.Number("margin_px", margin_px, {"px", 0, 300, "edges nearer to the border are not in the picture"});
  a.Number("sigmas", sigmas, {"-", 0, 5, "and so many standard deviations of where they are expected"});
  a.Number("max_pan_deg", max_pan_deg, {"deg", 1, 110, "farther the head does not turn"});
  a.Number("near_m", near_m,
           {"m", 0, 5, "nearer than this one of the pictures has to show the side, also of the next looks"});
  a.Number("lead_s", lead_s, {"s", 0, 3, "the robot drives on until the picture is taken"});
}

double OutsideBy(const HeadGeometry& head, const std::array<CameraModel, 2>& cameras, double tilt_rad,
                 const LandmarkEdge& edge, const LandmarkPrediction& prediction, const AimConfig& config) {
  if (edge.IsMovable()) return kBehind_px;
  if (edge.IsVertical()) {
    const Target target = TargetOf(head, edge, prediction, tilt_rad);
    return Missing(cameras, std::span(&target, 1), config);
  }
  if (!edge.IsLevel()) return kBehind_px;
  const Eigen::Isometry3d base_from_landmark = Lift(prediction.base_from_landmark);
  double worst = 0;
  for (const CameraModel& camera : cameras) {
    for (const Eigen::Vector3d& end : {edge.from, edge.to})
      worst = std::max(worst, MissingInHeight(camera, base_from_landmark * end, prediction, config));
  }
  return worst;
}

double SideOutsideBy(const HeadModel& head, const HeadSetting& setting, const LandmarkModel& model,
                     const LandmarkPrediction& prediction, int side, const AimConfig& config) {
  const auto its = SideTargets(head.geometry, model, prediction, setting.tilt_rad, side);
  const auto cameras = CamerasAt(head, setting, setting.pan_rad);
  return cameras ? MissingInBetter(*cameras, its, config) : kBehind_px;
}

double AimPan(const HeadModel& head, const HeadSetting& base, const LandmarkModel& model,
              const LandmarkPrediction& prediction, const LandmarkPrediction& afterwards, int side,
              const AimConfig& config) {
  const HeadGeometry& g = head.geometry;
  const auto its = SideTargets(g, model, prediction, base.tilt_rad, side);
  const auto later = SideTargets(g, model, afterwards, base.tilt_rad, side);
  const auto all = SideTargets(g, model, prediction, base.tilt_rad, 0);
  if (all.empty()) return 0;
  const bool near = prediction.base_from_landmark.translation().norm() < config.near_m;
  const double middle = Bearing(g, all), at_side = its.empty() ? middle : Bearing(g, its);
  const double limit = Radians(config.max_pan_deg);
  const double wanted = std::clamp(middle + config.side_share * WrapAngle(at_side - middle), -limit, limit);
  double best = wanted, best_cost = 1e18;
  // From the wanted angle outwards: of equal ones the nearest stays.
  for (double off = 0; off < Radians(40); off += kStep_rad) {
    for (const double pan : {wanted + off, wanted - off}) {
      const auto cameras = CamerasAt(head, base, pan);
      if (!cameras || std::abs(pan) > limit) continue;
      const double cost =
          near ? MissingInBetter(*cameras, its, config) + MissingInBetter(*cameras, later, config)
               : 10 * Missing(*cameras, its, config) + Missing(*cameras, all, config);
      if (cost >= best_cost - 1e-9) continue;
      best = pan;
      best_cost = cost;
    }
    if (best_cost == 0) break;
  }
  return best;
}

}  // namespace priamos::head
