#include "head/core/stereo/pair_order.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "head/core/stereo/edge_stereo.hpp"
#include "head/core/stereo/space_edge.hpp"

namespace priamos::head {
namespace {

constexpr double kMostWeight_px = 60;   ///< a longer line is no better evidence
constexpr double kStillReach_px = 2.5;  ///< what is moved by less stands still
constexpr double kLeastReach_px = 0.8;
constexpr double kLeastOverlap = 0.5;
constexpr int kFewestLines = 3;
constexpr double kSurelyStill = 0.7;
constexpr double kStillShare = 0.4;  // right pairs: up to 0.27; one image twice: 0.5 and more

struct Evidence {
  int n = 0;
  double weight = 0;
};

Evidence Weigh(const CameraView& first, const CameraView& second, const StereoOptions& options) {
  Evidence evidence;
  for (const StereoMatch& match : MatchBinocular(first, second, options)) {
    if (!match.space) continue;
    ++evidence.n;
    const double length_px =
        std::min(first.lines[match.left].length_px, second.lines[match.right.front()].length_px);
    evidence.weight += match.similarity * std::min(length_px, kMostWeight_px);
  }
  return evidence;
}

/// Where in the second image something appears that the first shows at `seen` [px, distorted], `depth_m`
/// away.
Eigen::Vector2d SeenInSecond(const CameraModel& first, const CameraModel& second, const Eigen::Vector2d& seen,
                             double depth_m) {
  const Eigen::Vector3d centre = OpticalCentre(first);
  const Eigen::Vector3d ray =
      first.image_from_base.leftCols<3>().inverse() * first.Undistort(seen).homogeneous();
  const Eigen::Vector3d point = centre + depth_m / MetricDepth(first, centre + ray) * ray;
  return second.Distort(second.Project(point));
}

/// How far across itself a line of the first image must move in the second, at least [px]; 0 where an edge of
/// space in range may appear at the same place.
double LeastMove(const CameraModel& first, const CameraModel& second, const EdgeSegment& line,
                 const StereoOptions& options) {
  const Eigen::Vector2d middle = (line.begin + line.end) / 2;
  const double near = line.normal().dot(SeenInSecond(first, second, middle, options.min_depth_m) - middle);
  const double far = line.normal().dot(SeenInSecond(first, second, middle, options.max_depth_m) - middle);
  return near * far <= 0 ? 0 : std::min(std::abs(near), std::abs(far));
}

/// Whether `b` is `a` again, moved by less than `reach_px`.
bool IsStill(const EdgeSegment& a, const EdgeSegment& b, double reach_px) {
  const Eigen::Vector2d d = a.direction();
  if (d.dot(b.direction()) < 0.95) return false;
  const Eigen::Vector2d from = b.begin - a.begin, to = b.end - a.begin, n = a.normal();
  if (std::abs(n.dot(from + to) / 2) > reach_px) return false;
  const double s = d.dot(from), t = d.dot(to), length_px = a.length_px();
  const double common = std::min(t, length_px) - std::max(s, 0.0);
  return common > kLeastOverlap * std::min(length_px, b.length_px());
}

void CountStill(const CameraView& first, const CameraView& second, const StereoOptions& options,
                PairOrder& order) {
  for (const EdgeSegment& line : first.edges->segments) {
    const double reach_px =
        std::min(kStillReach_px, 0.6 * LeastMove(*first.camera, *second.camera, line, options));
    if (reach_px < kLeastReach_px) continue;
    ++order.n_should_move;
    order.n_still += std::ranges::any_of(
        second.edges->segments, [&](const EdgeSegment& other) { return IsStill(line, other, reach_px); });
  }
}

/// Nothing moves. What also fits as it is must nearly all stand still; of very few lines all.
bool IsSameView(const PairOrder& order) {
  if (order.n_should_move >= kFewestLines && order.n_still > kSurelyStill * order.n_should_move) return true;
  if (order.n_still <= order.n_as_given) return false;
  if (order.n_should_move >= kFewestLines) return order.n_still > kStillShare * order.n_should_move;
  return order.n_still == order.n_should_move && order.n_as_given == 0;
}

PairVerdict VerdictOf(const PairOrder& order) {
  if (IsSameView(order)) return PairVerdict::kSameView;
  if (order.n_as_given == 0 && order.n_exchanged == 0) return PairVerdict::kUnknown;
  return order.exchanged > order.as_given ? PairVerdict::kExchanged : PairVerdict::kRight;
}

}  // namespace

PairOrder JudgeOrder(const CameraView& first, const CameraView& second, const StereoOptions& options) {
  const Evidence given = Weigh(first, second, options);
  const CameraView second_as_first = MakeView(*first.camera, *second.edges);
  const CameraView first_as_second = MakeView(*second.camera, *first.edges);
  const Evidence exchanged = Weigh(second_as_first, first_as_second, options);
  PairOrder order;
  order.n_as_given = given.n;
  order.as_given = given.weight;
  order.n_exchanged = exchanged.n;
  order.exchanged = exchanged.weight;
  CountStill(first, second, options, order);
  order.verdict = VerdictOf(order);
  return order;
}

}  // namespace priamos::head
