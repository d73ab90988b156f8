#include "head/core/stereo/edge_stereo.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "head/core/camera/projection.hpp"
#include "head/core/edges/segment_index.hpp"
#include "head/core/stereo/stereo_pairs.hpp"

namespace priamos::head {
namespace {

constexpr double kCollinear_px = 1.5;
constexpr double kMaxChi2 = 16;  ///< 2 degrees of freedom

/// Whether `b` continues `a`: on the same line, without a common part.
bool Continues(const ViewLine& a, const ViewLine& b) {
  if (std::abs(a.normal.dot(b.p - a.p)) > kCollinear_px || std::abs(a.normal.dot(b.q - a.p)) > kCollinear_px)
    return false;
  const Eigen::Vector2d d = (a.q - a.p) / a.length_px;
  const double s = d.dot(b.p - a.p), t = d.dot(b.q - a.p);
  return t > s && (s > a.length_px - 2 || t < 2);
}

/// The best pairs first; among equals their place in the lists decides.
void Rank(std::vector<StereoPair>& pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const StereoPair& a, const StereoPair& b) {
    return std::tuple(-a.similarity, a.first, a.second) < std::tuple(-b.similarity, b.first, b.second);
  });
}

StereoMatch MakeMatch(const CameraView& left, const CameraView& right, const StereoPair& pair,
                      const StereoOptions& options) {
  StereoMatch match;
  match.left = pair.first;
  match.right = {pair.second};
  match.epipolar_rad = pair.epipolar_rad;
  match.similarity = pair.similarity;
  match.is_near_epipolar = pair.epipolar_rad <= options.min_epipolar_rad;
  if (!match.is_near_epipolar) {
    const std::array<LineSighting, 2> sightings{{{&left, pair.first}, {&right, pair.second}}};
    match.space = Reconstruct(sightings, options.camera_sigma_px);
  }
  return match;
}

/// A triple of lines that may be one edge.
struct Triple {
  int left, right, third;
  double score = 0, epipolar_rad = 0;
  SpaceEdge space;
};

/// Finds third lines where two others predict the edge.
class TripleSearch {
 public:
  TripleSearch(const std::array<const CameraView*, 3>& views, const StereoOptions& options)
      : views_(views), options_(options) {
    for (const CameraView* view : views) {
      auto& index = indices_.emplace_back(view->size.width, view->size.height, 48);
      for (std::size_t i = 0; i < view->lines.size(); ++i)
        index.Insert(static_cast<int>(i), view->lines[i].p, view->lines[i].q);
    }
  }

  /// All pairs of views i, j, confirmed in view k.
  void Search(int i, int j, int k) {
    relation_ = RelationOf(*views_[i], *views_[k], options_);
    for (const StereoPair& pair : FindPairs(*views_[i], *views_[j], options_)) {
      if (pair.epipolar_rad <= options_.min_epipolar_rad) continue;
      const std::array<LineSighting, 2> two{{{views_[i], pair.first}, {views_[j], pair.second}}};
      if (const auto edge = Reconstruct(two, options_.camera_sigma_px)) Confirm(pair, *edge, i, j, k);
    }
  }
  std::vector<Triple>& triples() { return triples_; }

 private:
  void Confirm(const StereoPair& pair, const SpaceEdge& edge, int i, int j, int k) {
    const CameraView& view = *views_[k];
    if (MetricDepth(*view.camera, edge.from) < 0.1 || MetricDepth(*view.camera, edge.to) < 0.1) return;
    const Eigen::Vector2d a = view.camera->Project(edge.from), b = view.camera->Project(edge.to);
    near_.clear();
    indices_[k].Along(a, b, 8, near_);
    for (const int line : near_) {
      if (!Agrees(view, line, edge, a, b)) continue;
      const double grey = GreySimilarity(*views_[i], pair.first, view, line, relation_, options_);
      if (grey <= 0) continue;
      std::array<int, 3> lines{};
      lines[i] = pair.first;
      lines[j] = pair.second;
      lines[k] = line;
      Add(lines, pair, grey);
    }
  }

  /// The line passes the place where the epipolar lines of both ends cross, as well as that is known.
  bool Agrees(const CameraView& view, int index, const SpaceEdge& edge, const Eigen::Vector2d& a,
              const Eigen::Vector2d& b) const {
    const ViewLine& line = view.lines[index];
    const EdgeSegment& segment = view.edges->segments[line.segment];
    const Eigen::Vector2d ends[2] = {a, b};
    for (Eigen::Index end = 0; end < 2; ++end) {
      const Eigen::RowVector3d across =
          line.normal.transpose() * ProjectionJacobian(*view.camera, end == 0 ? edge.from : edge.to);
      const double variance = across * edge.covariance.block<3, 3>(3 * end, 3 * end) * across.transpose();
      const double sigma = std::sqrt(variance + segment.sigma_normal_px * segment.sigma_normal_px);
      if (std::abs(line.normal.dot(ends[end] - line.p)) > options_.max_distance_px + 3 * std::min(sigma, 1.0))
        return false;
    }
    const Eigen::Vector2d d = (line.q - line.p) / line.length_px;
    const double s = d.dot(a - line.p), t = d.dot(b - line.p);
    const double common = std::min(std::max(s, t), line.length_px) - std::max(std::min(s, t), 0.0);
    return common >= options_.min_overlap * std::min(line.length_px, std::abs(t - s));
  }

  void Add(const std::array<int, 3>& lines, const StereoPair& pair, double grey) {
    // The plane's normal points to the bright side: the sign of contrast.
    const auto plane = [&](int v) { return views_[v]->lines[lines[v]].plane.head<3>(); };
    if (plane(0).dot(plane(2)) < std::cos(options_.max_turn_rad)) return;
    std::array<LineSighting, 3> three;
    for (int v = 0; v < 3; ++v) three[v] = {views_[v], lines[v]};
    const auto edge = Reconstruct(three, options_.camera_sigma_px);
    if (!edge || edge->chi2 > kMaxChi2) return;
    triples_.push_back({lines[0], lines[1], lines[2], pair.similarity * grey * std::exp(-edge->chi2 / 8),
                        pair.epipolar_rad, *edge});
  }

  std::array<const CameraView*, 3> views_;
  const StereoOptions& options_;
  std::vector<SegmentIndex> indices_;
  GreyRelation relation_;  ///< of the first and the confirming view
  std::vector<int> near_;
  std::vector<Triple> triples_;
};

}  // namespace

std::vector<StereoMatch> MatchBinocular(const CameraView& left, const CameraView& right,
                                        const StereoOptions& options) {
  std::vector<StereoPair> pairs = FindPairs(left, right, options);
  Rank(pairs);
  std::vector<int> match_of_left(left.lines.size(), -1), match_of_right(right.lines.size(), -1);
  std::vector<StereoMatch> matches;
  for (const StereoPair& pair : pairs) {
    int &l = match_of_left[pair.first], &r = match_of_right[pair.second];
    if (l >= 0 || r >= 0) continue;
    l = r = static_cast<int>(matches.size());
    matches.push_back(MakeMatch(left, right, pair, options));
  }
  for (const StereoPair& pair : pairs) {
    int &l = match_of_left[pair.first], &r = match_of_right[pair.second];
    if (l >= 0 && r < 0) {
      StereoMatch& match = matches[l];
      if (!Continues(right.lines[match.right.front()], right.lines[pair.second])) continue;
      match.right.push_back(pair.second);
      r = l;
    } else if (l < 0 && r >= 0) {
      if (!Continues(left.lines[matches[r].left], left.lines[pair.first])) continue;
      l = static_cast<int>(matches.size());
      matches.push_back(MakeMatch(left, right, pair, options));
    }
  }
  return matches;
}

std::vector<StereoMatch> MatchTrinocular(const CameraView& left, const CameraView& right,
                                         const CameraView& third, const StereoOptions& options) {
  TripleSearch search({&left, &right, &third}, options);
  search.Search(0, 1, 2);
  search.Search(0, 2, 1);
  search.Search(1, 2, 0);
  auto& triples = search.triples();
  std::sort(triples.begin(), triples.end(), [](const Triple& a, const Triple& b) {
    return std::tuple(-a.score, a.left, a.right, a.third) < std::tuple(-b.score, b.left, b.right, b.third);
  });
  std::vector<bool> left_used(left.lines.size()), right_used(right.lines.size()),
      third_used(third.lines.size());
  std::vector<StereoMatch> matches;
  for (const Triple& t : triples) {
    if (left_used[t.left] || right_used[t.right] || third_used[t.third]) continue;
    left_used[t.left] = right_used[t.right] = third_used[t.third] = true;
    StereoMatch match;
    match.left = t.left;
    match.right = {t.right};
    match.third = {t.third};
    match.epipolar_rad = t.epipolar_rad;
    match.similarity = t.score;
    match.space = t.space;
    matches.push_back(std::move(match));
  }
  return matches;
}

}  // namespace priamos::head
