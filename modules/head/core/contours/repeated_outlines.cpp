#include "head/core/contours/repeated_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace priamos::head {
namespace {

/// Corners so near to each other are one: both of its sides may lie 8 px beside the other's, ...
constexpr double kBeside_px = 8 * std::numbers::sqrt2;
/// ... in small outlines this share of the shortest side.
constexpr double kBesideShare = 0.15;

/// An outline with what decides which of several is kept.
struct Candidate {
  const Polygon* polygon = nullptr;
  std::vector<Eigen::Vector2d> outline;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double shortest_px = std::numeric_limits<double>::infinity();
  double changed_px = 0;  ///< by how much its sides were extended and shortened, all corners together
};

Candidate MakeCandidate(const Polygon& polygon, std::span<const Corner> corners) {
  Candidate candidate;
  candidate.polygon = &polygon;
  for (const int c : polygon.corners) {
    candidate.outline.push_back(corners[c].at);
    candidate.middle += corners[c].at / double(polygon.corners.size());
    for (const double extension : corners[c].extension_px) candidate.changed_px += std::abs(extension);
  }
  for (std::size_t i = 0; i < candidate.outline.size(); ++i) {
    const Eigen::Vector2d& next = candidate.outline[(i + 1) % candidate.outline.size()];
    candidate.shortest_px = std::min(candidate.shortest_px, (next - candidate.outline[i]).norm());
  }
  return candidate;
}

/// Whether every corner of `a` lies beside the one of `b`, from whichever corner they are counted.
bool Coincide(const Candidate& a, const Candidate& b) {
  const std::size_t n = a.outline.size();
  const double reach = std::min(kBeside_px, kBesideShare * std::min(a.shortest_px, b.shortest_px));
  if (b.outline.size() != n || (a.middle - b.middle).norm() > reach) return false;
  for (std::size_t shift = 0; shift < n; ++shift) {
    std::size_t i = 0;
    while (i < n && (a.outline[i] - b.outline[(i + shift) % n]).norm() <= reach) ++i;
    if (i == n) return true;
  }
  return false;
}

}  // namespace

std::vector<Polygon> WithoutRepeated(std::span<const Polygon> polygons, std::span<const Corner> corners) {
  std::vector<Candidate> candidates;
  candidates.reserve(polygons.size());
  for (const Polygon& polygon : polygons) candidates.push_back(MakeCandidate(polygon, corners));
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.changed_px < b.changed_px; });
  std::vector<const Candidate*> kept;
  std::vector<Polygon> result;
  for (const Candidate& candidate : candidates) {
    if (std::ranges::any_of(kept, [&](const Candidate* other) { return Coincide(candidate, *other); }))
      continue;
    kept.push_back(&candidate);
    result.push_back(*candidate.polygon);
  }
  return result;
}

}  // namespace priamos::head
