#include "head/core/scene/missing_border.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

constexpr double kLeast_px = 80;         ///< of it in the picture: less tells nothing
constexpr double kBesideBorder_px = 10;  ///< the pose is not exact, nor is its place
constexpr double kTurned_rad = 0.15, kMostSeen = 0.2;
constexpr int kBorderSteps = 24;

}  // namespace

bool IsMissing(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const CameraModel& camera,
               std::span<const ImageLine> lines) {
  const auto edge = ProjectEdge(camera, ImageSize{}, from, to);
  if (!edge || edge->length_px() < kLeast_px) return false;
  const Eigen::Vector2d direction = edge->direction();
  int seen = 0;
  for (int i = 0; i < kBorderSteps; ++i) {
    const Eigen::Vector2d at = edge->p + (i + 0.5) / kBorderSteps * (edge->q - edge->p);
    seen += std::any_of(lines.begin(), lines.end(), [&](const ImageLine& line) {
      return std::abs((line.q - line.p).normalized().dot(direction)) > std::cos(kTurned_rad) &&
             DistanceToSegment(line.p, line.q, at) < kBesideBorder_px;
    });
  }
  return seen < kMostSeen * kBorderSteps;
}

}  // namespace priamos::head
