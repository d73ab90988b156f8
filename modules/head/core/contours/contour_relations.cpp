#include "head/core/contours/contour_relations.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>

#include "common/geometry.hpp"
#include "head/core/edges/segment_index.hpp"

namespace priamos::head {
namespace {

constexpr double kCell_px = 32, kSigmas = 3;
constexpr double kMaxNoise_rad = 0.05;  ///< no segment is so uncertain that anything would be parallel to it

/// Where the lines of `a` and `b` cross; nullopt if they hardly do.
std::optional<Eigen::Vector2d> Crossing(const EdgeSegment& a, const EdgeSegment& b, double min_angle_rad) {
  const Eigen::Vector2d u = a.direction(), v = b.direction(), delta = b.centre - a.centre;
  const double cross = u.x() * v.y() - u.y() * v.x();
  if (std::abs(cross) < std::sin(min_angle_rad)) return std::nullopt;
  return a.centre + (delta.x() * v.y() - delta.y() * v.x()) / cross * u;
}

/// How far `at`, a point of the segment's line, lies beyond the nearest end; negative inside.
double Beyond(const EdgeSegment& s, const Eigen::Vector2d& at) {
  const Eigen::Vector2d d = s.direction();
  return std::max(d.dot(s.begin - at), d.dot(at - s.end));
}

double AngleNoise(const EdgeSegment& a, const EdgeSegment& b) {
  return std::min(kSigmas * std::hypot(a.sigma_angle_rad, b.sigma_angle_rad), kMaxNoise_rad);
}

/// Signed distance of the middle of `s` from the line of `other`, and its standard deviation.
std::pair<double, double> Beside(const EdgeSegment& s, const EdgeSegment& other) {
  const Eigen::Vector2d delta = (s.begin + s.end) / 2 - other.centre;
  return {other.normal().dot(delta),
          std::hypot(other.SigmaAt(other.direction().dot(delta)), s.sigma_normal_px)};
}

double DistanceToPoint(const EdgeSegment& s, const Eigen::Vector2d& p) {
  const Eigen::Vector2d d = s.direction();
  const double along = std::clamp(d.dot(p - s.begin), 0.0, s.length_px());
  return (s.begin + along * d - p).norm();
}

/// Smallest distance between two segments that do not cross.
double DistanceBetween(const EdgeSegment& a, const EdgeSegment& b) {
  return std::min({DistanceToPoint(a, b.begin), DistanceToPoint(a, b.end), DistanceToPoint(b, a.begin),
                   DistanceToPoint(b, a.end)});
}

void CompareParallel(const EdgeSegment& a, const EdgeSegment& b, const ContourOptions& options, Relation& r) {
  const bool a_is_shorter = a.length_px() < b.length_px();
  const auto [beside, sigma] = a_is_shorter ? Beside(a, b) : Beside(b, a);
  const Eigen::Vector2d d = a.direction();
  const double s = d.dot(b.begin - a.begin), t = d.dot(b.end - a.begin);
  const double overlap = std::min(a.length_px(), std::max(s, t)) - std::max(0.0, std::min(s, t));
  r.distance_px = std::abs(beside);
  r.same_sign = d.dot(b.direction()) > 0;
  if (r.distance_px < options.collinear_px + kSigmas * sigma) {
    r.collinear = overlap <= 0;
  } else {
    r.parallel = overlap > 0;
  }
}

std::optional<Relation> Relate(const EdgeSegment& a, const EdgeSegment& b, const ContourOptions& options) {
  const Eigen::Vector2d u = a.direction(), v = b.direction();
  Relation r;
  r.angle_rad = std::acos(std::clamp(std::abs(u.dot(v)), 0.0, 1.0));
  const double noise = AngleNoise(a, b);
  const auto crossing = Crossing(a, b, options.min_corner_rad);
  if (crossing) {
    const auto reach = [&](const EdgeSegment& s) {
      return std::min(options.max_extension_px, options.max_extension_share * s.length_px());
    };
    r.intersecting = Beyond(a, *crossing) <= reach(a) && Beyond(b, *crossing) <= reach(b);
  }
  if (!r.intersecting && DistanceBetween(a, b) > options.neighbour_px) return std::nullopt;
  if (r.angle_rad < options.parallel_rad + noise) CompareParallel(a, b, options, r);
  r.perpendicular = r.angle_rad > kPi / 2 - options.perpendicular_rad - noise;
  if (!r.parallel && !r.perpendicular && !r.collinear && !r.intersecting) return std::nullopt;
  return r;
}

/// Error propagation: each line holds the corner in the direction of its normal as well as it is known there.
Eigen::Matrix2d CornerCovariance(const EdgeSegment& a, const EdgeSegment& b, const Eigen::Vector2d& at) {
  Eigen::Matrix2d normals;
  normals << a.normal().transpose(), b.normal().transpose();
  const Eigen::Vector2d sigma(a.SigmaAt(a.direction().dot(at - a.centre)),
                              b.SigmaAt(b.direction().dot(at - b.centre)));
  const Eigen::Matrix2d spread = normals.inverse() * sigma.asDiagonal();
  return spread * spread.transpose();
}

/// The corner at one end of `a` with the nearer end of `b`, if there is one.
std::optional<Corner> Meet(std::span<const EdgeSegment> segments, int a, int end, int b,
                           const ContourOptions& options) {
  const EdgeSegment &s = segments[a], &t = segments[b];
  const auto at = Crossing(s, t, options.min_corner_rad);
  if (!at) return std::nullopt;
  Corner corner{*at, {}, {a, b}, {end, 0}, {}};
  corner.ends[1] = (t.end - *at).squaredNorm() < (t.begin - *at).squaredNorm() ? 1 : 0;
  for (int i = 0; i < 2; ++i) {
    const EdgeSegment& side = segments[corner.segments[i]];
    const Eigen::Vector2d out = corner.ends[i] == 1 ? side.direction() : Eigen::Vector2d(-side.direction());
    corner.extension_px[i] = out.dot(*at - (corner.ends[i] == 1 ? side.end : side.begin));
    const double reach = std::min(options.max_extension_px, options.max_extension_share * side.length_px());
    if (std::abs(corner.extension_px[i]) > reach) return std::nullopt;
  }
  corner.covariance = CornerCovariance(s, t, *at);
  return corner;
}

/// How much had to be repaired.
double Cost(const Corner& c) {
  return std::hypot(c.extension_px[0], c.extension_px[1]);
}

/// The corners at one end of segment `i`, those that needed the least repair first.
std::vector<Corner> CornersAt(const EdgeImage& edges, int i, int end, const std::vector<int>& near,
                              const ContourOptions& options) {
  std::vector<Corner> here;
  for (const int other : near) {
    if (other == i) continue;
    if (const auto corner = Meet(edges.segments, i, end, other, options)) here.push_back(*corner);
  }
  std::sort(here.begin(), here.end(), [](const Corner& a, const Corner& b) { return Cost(a) < Cost(b); });
  return here;
}

/// A corner was found from both of its sides, unless one of them knew too many better ones: kept once.
void KeepOnce(std::vector<Corner>& corners) {
  for (Corner& c : corners) {
    if (c.segments[0] < c.segments[1]) continue;
    std::swap(c.segments[0], c.segments[1]);
    std::swap(c.ends[0], c.ends[1]);
    std::swap(c.extension_px[0], c.extension_px[1]);
  }
  const auto key = [](const Corner& c) {
    return std::tuple(c.segments[0], c.ends[0], c.segments[1], c.ends[1]);
  };
  std::sort(corners.begin(), corners.end(),
            [&](const Corner& a, const Corner& b) { return key(a) < key(b); });
  corners.erase(std::unique(corners.begin(), corners.end(),
                            [&](const Corner& a, const Corner& b) { return key(a) == key(b); }),
                corners.end());
}

}  // namespace

std::vector<Relation> FindRelations(const EdgeImage& edges, const ContourOptions& options) {
  SegmentIndex index(edges.width, edges.height, kCell_px);
  std::vector<Relation> relations;
  std::vector<int> near;
  for (std::size_t i = 0; i < edges.segments.size(); ++i) {
    const EdgeSegment& s = edges.segments[i];
    near.clear();
    index.Along(s.begin, s.end, std::max(options.neighbour_px, 1.5 * options.max_extension_px), near);
    for (const int other : near) {
      auto relation = Relate(edges.segments[other], s, options);
      if (!relation) continue;
      relation->a = other;
      relation->b = static_cast<int>(i);
      relations.push_back(*relation);
    }
    index.Insert(static_cast<int>(i), s.begin, s.end);
  }
  return relations;
}

std::vector<Corner> FindCorners(const EdgeImage& edges, const ContourOptions& options) {
  SegmentIndex index(edges.width, edges.height, kCell_px);
  for (std::size_t i = 0; i < edges.segments.size(); ++i)
    index.Insert(static_cast<int>(i), edges.segments[i].begin, edges.segments[i].end);
  std::vector<Corner> corners;
  std::vector<int> near;
  for (int i = 0; i < static_cast<int>(edges.segments.size()); ++i) {
    for (const int end : {0, 1}) {
      const Eigen::Vector2d at = end == 1 ? edges.segments[i].end : edges.segments[i].begin;
      near.clear();
      // Both sides may have to be extended, at a sharp angle.
      index.Near(at, 2 * options.max_extension_px, near);
      std::sort(near.begin(), near.end());
      near.erase(std::unique(near.begin(), near.end()), near.end());
      const std::vector<Corner> here = CornersAt(edges, i, end, near, options);
      const auto kept = std::min(here.size(), std::size_t(options.max_corners_per_end));
      corners.insert(corners.end(), here.begin(), here.begin() + kept);
    }
  }
  KeepOnce(corners);
  return corners;
}

}  // namespace priamos::head
