#include "head/core/stereo/stereo_pairs.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "head/core/stereo/space_edge.hpp"

namespace priamos::head {
namespace {

/// The epipolar geometry of two views.
struct Pairing {
  const CameraView &first, &second;
  Eigen::Vector3d epipole_in_first, epipole_in_second;
  Eigen::Matrix3d fundamental;  ///< second^T * fundamental * first = 0

  Pairing(const CameraView& a, const CameraView& b)
      : first(a),
        second(b),
        epipole_in_first(Epipole(*a.camera, *b.camera)),
        epipole_in_second(Epipole(*b.camera, *a.camera)) {
    const Eigen::Matrix3d infinity =
        b.camera->image_from_base.leftCols<3>() * a.camera->image_from_base.leftCols<3>().inverse();
    const Eigen::Vector3d& e = epipole_in_second;
    Eigen::Matrix3d cross;
    cross << 0, -e.z(), e.y(), e.z(), 0, -e.x(), -e.y(), e.x(), 0;
    fundamental = cross * infinity;
  }
};

/// Share of the common extent: the ends of one line, carried along epipolar lines onto the other.
double Overlap(const Pairing& pairing, const ViewLine& a, const ViewLine& b) {
  const Eigen::Vector2d d = (b.q - b.p) / b.length_px;
  double t[2];
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d epipolar = pairing.fundamental * (end == 0 ? a.p : a.q).homogeneous();
    const double slope = epipolar.head<2>().dot(d);
    if (std::abs(slope) < 1e-3 * epipolar.head<2>().norm()) return 0;
    t[end] = -epipolar.dot(b.p.homogeneous()) / slope;
  }
  const double low = std::min(t[0], t[1]), high = std::max(t[0], t[1]);
  const double common = std::min(high, b.length_px) - std::max(low, 0.0);
  return common <= 0 ? 0 : common / std::max(1.0, std::min(high - low, b.length_px));
}

/// Along the epipolar line the ends do not count: the lines must be the same one.
bool LieOnOneEpipolarLine(const Pairing& pairing, const ViewLine& a, const ViewLine& b) {
  constexpr double kReach_px = 2.5;
  const Eigen::Vector3d epipolar = pairing.fundamental * ((a.p + a.q) / 2).homogeneous();
  const double scale = epipolar.head<2>().norm();
  return std::abs(epipolar.dot(((b.p + b.q) / 2).homogeneous())) / scale <
         kReach_px + 0.15 * (a.length_px + b.length_px) / 2;
}

/// Sign of contrast: the planes' normals point to the bright side, as seen from either camera.
bool FacesTheSameWay(const ViewLine& a, const ViewLine& b, const StereoOptions& options) {
  return a.plane.head<3>().dot(b.plane.head<3>()) > std::cos(options.max_turn_rad);
}

/// The middle of the first line, seen on the plane of sight of the second, lies before both cameras.
bool IsInRange(const Pairing& pairing, const ViewLine& a, const ViewLine& b, const StereoOptions& options) {
  const Eigen::Matrix3d m = pairing.first.camera->image_from_base.leftCols<3>();
  const Eigen::Vector3d centre = OpticalCentre(*pairing.first.camera);
  const Eigen::Vector3d ray = m.inverse() * ((a.p + a.q) / 2).homogeneous();
  const double distance = -b.plane.dot(centre.homogeneous()) / b.plane.head<3>().dot(ray);
  const Eigen::Vector3d point = centre + distance * ray;
  for (const CameraView* view : {&pairing.first, &pairing.second}) {
    const double depth = MetricDepth(*view->camera, point);
    if (!(depth > options.min_depth_m && depth < options.max_depth_m)) return false;
  }
  return true;
}

/// Pairs of lines whose places allow that they are one edge; `similarity` is that of their extents.
std::vector<StereoPair> PairsByPlace(const CameraView& first, const CameraView& second,
                                     const StereoOptions& options) {
  const Pairing pairing(first, second);
  std::vector<double> angle_in_second(second.lines.size());
  for (std::size_t j = 0; j < second.lines.size(); ++j)
    angle_in_second[j] = EpipolarAngle(second.lines[j], pairing.epipole_in_second);
  std::vector<StereoPair> pairs;
  for (std::size_t i = 0; i < first.lines.size(); ++i) {
    const ViewLine& a = first.lines[i];
    const double angle = EpipolarAngle(a, pairing.epipole_in_first);
    for (std::size_t j = 0; j < second.lines.size(); ++j) {
      const ViewLine& b = second.lines[j];
      if (!FacesTheSameWay(a, b, options)) continue;
      StereoPair pair{static_cast<int>(i), static_cast<int>(j), 0, std::min(angle, angle_in_second[j])};
      double overlap = 1;
      if (pair.epipolar_rad > options.min_epipolar_rad) {
        overlap = Overlap(pairing, a, b);
        if (overlap < options.min_overlap || !IsInRange(pairing, a, b, options)) continue;
      } else if (!LieOnOneEpipolarLine(pairing, a, b)) {
        continue;
      }
      const double shorter = std::min(a.length_px, b.length_px), longer = std::max(a.length_px, b.length_px);
      pair.similarity = overlap * std::sqrt(shorter / longer);
      pairs.push_back(pair);
    }
  }
  return pairs;
}

GreyRelation RelationOf(const CameraView& first, const CameraView& second,
                        const std::vector<StereoPair>& pairs) {
  std::vector<LinePair> lines;
  lines.reserve(pairs.size());
  for (const StereoPair& pair : pairs) lines.push_back({pair.first, pair.second});
  return EstimateGreyRelation(first, second, lines);
}

/// Distance of two grey values; one that is white may have been brighter.
double GreyDistance(double related, double seen, bool from_white) {
  return from_white && seen > related ? 0 : std::abs(seen - related);
}

}  // namespace

double GreySimilarity(const CameraView& a, int line_a, const CameraView& b, int line_b,
                      const GreyRelation& relation, const StereoOptions& options) {
  constexpr double kWhite = 252;
  const ViewLine &in_a = a.lines[line_a], &in_b = b.lines[line_b];
  const EdgeSegment &s = a.edges->segments[in_a.segment], &t = b.edges->segments[in_b.segment];
  const double far_a = FarFromCentre(a, in_a), far_b = FarFromCentre(b, in_b);
  const double dark = relation.Of(s.grey_left, far_a, far_b),
               bright = relation.Of(s.grey_right, far_a, far_b);
  const double ratio = (bright - dark) / t.contrast();
  const bool is_white = s.grey_right > kWhite;
  if (ratio > options.max_contrast_ratio || (ratio * options.max_contrast_ratio < 1 && !is_white)) return 0;
  // What lies behind an edge changes with the viewpoint, so one side may differ.
  const double scale = std::min(1.0, relation.Slope(far_a, far_b));  // grey values of the brighter image
  const double left = GreyDistance(dark, t.grey_left, s.grey_left > kWhite) / scale,
               right = GreyDistance(bright, t.grey_right, is_white) / scale;
  const double better = std::min(left, right), worse = std::max(left, right);
  if (better > options.max_grey_difference) return 0;
  return std::exp(-(better + 0.3 * worse) / options.max_grey_difference);
}

GreyRelation RelationOf(const CameraView& first, const CameraView& second, const StereoOptions& options) {
  return RelationOf(first, second, PairsByPlace(first, second, options));
}

std::vector<StereoPair> FindPairs(const CameraView& first, const CameraView& second,
                                  const StereoOptions& options) {
  std::vector<StereoPair> pairs = PairsByPlace(first, second, options);
  const GreyRelation relation = RelationOf(first, second, pairs);
  for (StereoPair& pair : pairs)
    pair.similarity *= GreySimilarity(first, pair.first, second, pair.second, relation, options);
  std::erase_if(pairs, [](const StereoPair& pair) { return pair.similarity <= 0; });
  return pairs;
}

}  // namespace priamos::head
