#include "head/core/door_detection.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

namespace priamos::head {
namespace {

constexpr double kMinSpanShare = 0.5;  ///< of the way between two uprights that a lintel must be seen on
constexpr double kBorderPx = 8;        ///< what ends here may go on outside of the picture

/// Height at which an image line passes the upright at `at`.
double HeightOn(const ViewLine& line, const Eigen::Vector2d& at) {
  return -(line.plane.x() * at.x() + line.plane.y() * at.y() + line.plane.w()) / line.plane.z();
}

Eigen::Vector2d Image(const CameraView& view, const Eigen::Vector2d& at, double z) {
  return view.camera->Project({at.x(), at.y(), z});
}

/// How well a line is the lintel between two uprights: heights over both, and the distance of its ends from
/// the corners along its direction.
struct Lintel {
  double height_a, height_b, gap_px, covered;
};

std::optional<Lintel> AsLintel(const CameraView& view, const ViewLine& line, const VerticalEdge& a,
                               const VerticalEdge& b, const DoorDetectionOptions& options) {
  if (std::abs(line.plane.z()) < 0.05) return std::nullopt;
  const double za = HeightOn(line, a.at), zb = HeightOn(line, b.at);
  if (za < options.min_height_m || za > options.max_height_m || std::abs(za - zb) > options.level_m)
    return std::nullopt;
  const Eigen::Vector2d p = Image(view, a.at, za), q = Image(view, b.at, zb);
  const double span = (q - p).norm();
  if (span < 20) return std::nullopt;
  const Eigen::Vector2d way = (q - p) / span;
  double s = way.dot(line.p - p), t = way.dot(line.q - p);
  if (s > t) std::swap(s, t);
  const double covered = std::max(0.0, std::min(t, span) - std::max(s, 0.0)) / span;
  return Lintel{za, zb, std::max(std::abs(s), std::abs(t - span)), covered};
}

/// The line that fits best as a lintel at `height` (any if 0), its ends at both uprights.
std::optional<Lintel> FindLintel(const CameraView& view, const VerticalEdge& a, const VerticalEdge& b,
                                 double height, const DoorDetectionOptions& options) {
  std::optional<Lintel> best;
  for (const ViewLine& line : view.lines) {
    const auto lintel = AsLintel(view, line, a, b, options);
    if (!lintel || lintel->gap_px > options.corner_px || lintel->covered < kMinSpanShare) continue;
    if (height > 0 && std::abs((lintel->height_a + lintel->height_b) / 2 - height) > options.level_m)
      continue;
    if (!best || lintel->gap_px < best->gap_px) best = lintel;
  }
  return best;
}

/// Where an upright ends below, if the end is in the picture.
enum class Foot { kOnFloor, kOutside, kInTheAir };

Foot FootOf(const CameraView& view, int line, const VerticalEdge& upright,
            const DoorDetectionOptions& options) {
  const ViewLine& l = view.lines[line];
  const double v = std::max(l.p.y(), l.q.y());
  if (v > view.size.height - 1 - kBorderPx) return Foot::kOutside;
  return upright.z_min_m < options.floor_m ? Foot::kOnFloor : Foot::kInTheAir;
}

struct Candidate {
  DetectedDoor door;
  double gap_px;
  int support =
      0;  ///< candidates around the same middle: a frame has several edges on each side, a leaf has one
};

void CountSupport(std::vector<Candidate>& candidates) {
  constexpr double kSameMiddle_m = 0.03, kSameYaw = 0.1;
  for (Candidate& a : candidates) {
    a.support = static_cast<int>(std::count_if(candidates.begin(), candidates.end(), [&](const Candidate& b) {
      const Pose2 &p = a.door.base_from_door, &q = b.door.base_from_door;
      return (p.translation() - q.translation()).norm() < kSameMiddle_m &&
             std::abs(WrapAngle(p.yaw - q.yaw)) < kSameYaw;
    }));
  }
}

std::optional<Candidate> AsDoor(const CameraView& left, const CameraView& right, const VerticalEdge& a,
                                const VerticalEdge& b, const DoorDetectionOptions& options) {
  const Eigen::Vector2d way = b.at - a.at;
  const double width = way.norm();
  if (width < options.min_width_m || width > options.max_width_m) return std::nullopt;
  const auto l = FindLintel(left, a, b, 0, options);
  if (!l) return std::nullopt;
  const double height = (l->height_a + l->height_b) / 2;
  const auto r = FindLintel(right, a, b, height, options);
  if (!r) return std::nullopt;
  for (const VerticalEdge* upright : {&a, &b}) {
    if (upright->z_max_m < height - options.max_missing_m) return std::nullopt;
    if (upright->z_max_m > height + options.max_missing_m) return std::nullopt;
  }
  const Foot foot_a = FootOf(left, a.left, a, options), foot_b = FootOf(left, b.left, b, options);
  if (foot_a == Foot::kInTheAir && foot_b == Foot::kInTheAir) return std::nullopt;
  DetectedDoor door;
  const Eigen::Vector2d middle = (a.at + b.at) / 2;
  // From the right upright to the left one is the door's y axis; the robot is on its -x side.
  double yaw = std::atan2(way.y(), way.x()) - kPi / 2;
  if (std::cos(yaw) * middle.x() + std::sin(yaw) * middle.y() < 0) yaw += kPi;
  door.base_from_door = {middle.x(), middle.y(), WrapAngle(yaw)};
  door.covariance = (a.covariance + b.covariance) / 4;
  door.width_m = width, door.height_m = height;
  door.on_floor = foot_a == Foot::kOnFloor || foot_b == Foot::kOnFloor;
  return Candidate{door, std::max(l->gap_px, r->gap_px), 0};
}

}  // namespace

std::vector<DetectedDoor> DetectDoors(const CameraView& left, const CameraView& right,
                                      const DoorDetectionOptions& options) {
  std::vector<VerticalEdge> uprights = MatchVerticals(left, right, options.stereo);
  std::erase_if(uprights,
                [&](const VerticalEdge& v) { return v.z_max_m - v.z_min_m < options.min_upright_m; });
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < uprights.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const VerticalEdge &a = uprights[i], &b = uprights[j];
      if (a.left == b.left || a.right == b.right) continue;
      if (const auto c = AsDoor(left, right, a, b, options)) candidates.push_back(*c);
    }
  }
  CountSupport(candidates);
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.support != b.support ? a.support > b.support : a.gap_px < b.gap_px;
  });
  std::vector<DetectedDoor> doors;
  for (const Candidate& c : candidates) {
    const bool known = std::any_of(doors.begin(), doors.end(), [&](const DetectedDoor& d) {
      return (d.base_from_door.translation() - c.door.base_from_door.translation()).norm() <
             options.same_door_m;
    });
    if (!known) doors.push_back(c.door);
  }
  return doors;
}

}  // namespace priamos::head
