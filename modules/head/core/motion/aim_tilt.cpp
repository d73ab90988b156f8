#include "head/core/motion/aim_tilt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "common/image_size.hpp"

namespace priamos::head {
namespace {

const double kTiltStep_rad = Radians(0.5);
constexpr double kMiddle_px = ImageSize{}.height / 2.0;

/// The middles of the level edges that are seen from the base, base frame.
std::vector<Eigen::Vector3d> LevelEdges(const LandmarkModel& model, const Pose2& base_from_landmark) {
  const Eigen::Vector2d viewer = base_from_landmark.Inverse().translation();
  std::vector<Eigen::Vector3d> middles;
  for (const LandmarkEdge& edge : model.edges)
    if (edge.IsLevel() && edge.IsSeenFrom(viewer))
      middles.push_back(Lift(base_from_landmark) * Eigen::Vector3d((edge.from + edge.to) / 2));
  return middles;
}

/// The heights at which both pictures of a setting show a point, of the upper and of the lower one [px];
/// nullopt where one does not.
std::optional<std::pair<double, double>> Heights(const HeadModel& head, const HeadSetting& setting,
                                                 const Eigen::Vector3d& point) {
  double upper = std::numeric_limits<double>::infinity(), lower = -upper;
  for (const int camera : {kLeft, kRight}) {
    const auto model = head.CameraAt(setting, camera);
    if (!model || !(model->Depth(point) > 0.1)) return std::nullopt;
    const double y = model->Project(point).y();
    upper = std::min(upper, y);
    lower = std::max(lower, y);
  }
  return std::pair(upper, lower);
}

/// A setting that shows a level edge, and the middle of that edge, base frame.
struct Sight {
  HeadSetting setting;
  Eigen::Vector3d edge;
};

/// The least tilt up from that of `base` at which both pictures show a point below their upper border.
std::optional<Sight> Showing(const HeadModel& head, const HeadSetting& base, const Eigen::Vector3d& edge,
                             const TiltConfig& config) {
  HeadSetting setting = base;
  setting.pan_rad = std::atan2(edge.y() - head.geometry.y_m, edge.x() - head.geometry.x_m);
  for (; setting.tilt_rad >= -Radians(config.most_deg); setting.tilt_rad -= kTiltStep_rad) {
    const auto heights = Heights(head, setting, edge);
    if (heights && heights->first >= config.margin_px) return Sight{setting, edge};
  }
  return std::nullopt;
}

/// That of the edge for which the head has to look up the most, of those that can be shown at all.
std::optional<Sight> Highest(const HeadModel& head, const HeadSetting& base, const LandmarkModel& model,
                             const Pose2& base_from_landmark, const TiltConfig& config) {
  std::optional<Sight> highest;
  for (const Eigen::Vector3d& edge : LevelEdges(model, base_from_landmark)) {
    const auto sight = Showing(head, base, edge, config);
    if (sight && (!highest || sight->setting.tilt_rad < highest->setting.tilt_rad)) highest = sight;
  }
  return highest;
}

}  // namespace

void TiltConfig::Describe(Archive& a) {
  a.Number("most_deg", most_deg, {"deg", 0, 45, "a look is tilted up no farther than this"});
  a.Number("margin_px", margin_px, {"px", 0, 250, "edges nearer to the upper border are not in the picture"});
  a.Number("ahead_s", ahead_s,
           {"s", 0, 5, "looks are tilted up as far as the next one will need, so much later"});
}

double AimTilt(const HeadModel& head, const HeadSetting& base, const LandmarkModel& model,
               const Pose2& base_from_landmark, const Pose2& afterwards, const TiltConfig& config) {
  const auto now = Highest(head, base, model, base_from_landmark, config);
  if (!now) return base.tilt_rad;
  const auto then = Highest(head, now->setting, model, afterwards, config);
  HeadSetting setting = now->setting;
  while (then && setting.tilt_rad - kTiltStep_rad >= then->setting.tilt_rad) {
    setting.tilt_rad -= kTiltStep_rad;
    const auto heights = Heights(head, setting, now->edge);
    if (!heights || heights->second > kMiddle_px) return setting.tilt_rad + kTiltStep_rad;
  }
  return setting.tilt_rad;
}

int LevelEdgesShown(const HeadModel& head, const HeadSetting& setting, const LandmarkModel& model,
                    const Pose2& base_from_landmark, const TiltConfig& config) {
  const auto edges = LevelEdges(model, base_from_landmark);
  return static_cast<int>(std::ranges::count_if(edges, [&](const Eigen::Vector3d& edge) {
    const auto heights = Heights(head, setting, edge);
    return heights && heights->first >= config.margin_px &&
           heights->second <= ImageSize{}.height - 1 - config.margin_px;
  }));
}

}  // namespace priamos::head
