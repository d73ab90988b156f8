#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "planner/core/graph/floor_graph.hpp"

/// Which points of the graph are one.
namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// Points that are one are no farther apart than this.
constexpr double kMostApart_m = 0.6;
/// The edges of a thin wall are 14 cm apart: points nearer than this are the same one, and one that may be
/// farther away, by three sigmas, may be the other.
constexpr double kOnePoint_m = 0.07;
/// A wall ends at a point that is no farther from its end, and from its line, than this.
constexpr double kAtEnd_m = 0.3;
/// What was heard from poses so near to each other was heard together.
constexpr int kTogether = 1;
/// A robot tells no crowds of points: of so many pairs that are near each other no more are looked at.
constexpr int kMostPairs = 300;
/// Another point that lies up to so many sigmas farther off than the one that is meant could be meant as
/// well.
constexpr double kRival = 2;

}  // namespace

/// Those that still stand for a place.
std::set<int> FloorGraph::TiedPoints() const {
  std::set<int> tied;
  for (const auto& [name, told] : points_) tied.insert(told.sight.point);
  return tied;
}

std::optional<FloorGraph::Candidate> FloorGraph::PointCandidate(int kept, int gone) const {
  Candidate candidate;
  candidate.kept = {GraphNode::Kind::kPoint, kept};
  candidate.gone = {GraphNode::Kind::kPoint, gone};
  candidate.error = graph_.point(gone) - graph_.point(kept);
  if (candidate.error.norm() > kMostApart_m) return std::nullopt;
  const auto covariance = graph_.CovarianceOf({candidate.kept, candidate.gone});
  if (!covariance) return std::nullopt;
  candidate.by << -Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Identity();
  Eigen::Matrix2d spread = candidate.by * *covariance * candidate.by.transpose();
  spread.diagonal() += UnevenOf(candidate.kept).cwiseAbs2();
  candidate.sigma_m = std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvalues()(1));
  candidate.distance = std::sqrt(candidate.error.dot(spread.ldlt().solve(candidate.error)));
  return candidate;
}

/// Two numbers of what was heard at the same place mean two points.
bool FloorGraph::AreHeardTogether(int one, int other) const {
  for (const auto& [name, told] : points_) {
    if (told.sight.point != one) continue;
    for (const auto& [other_name, other_told] : points_)
      if (other_told.sight.point == other && std::abs(told.sight.pose - other_told.sight.pose) <= kTogether)
        return true;
  }
  return false;
}

/// From where a point was found each time, map frame.
std::vector<Vector2d> FloorGraph::FoundTowards(int point) const {
  std::vector<Vector2d> towards;
  for (const auto& [name, told] : points_)
    if (told.sight.point == point)
      towards.emplace_back(graph_.pose(told.sight.pose).rotation() * told.towards);
  return towards;
}

/// Whether two points were found from the same side of each wall that ends at them: the edge that is found
/// from a corridor is one side of a thin wall, and the one that is found from the room behind is the other.
bool FloorGraph::AreOnOneSide(const Candidate& candidate,
                              const std::map<int, std::vector<WallSpan>>& spans) const {
  const Vector2d at = (graph_.point(candidate.kept.index) + graph_.point(candidate.gone.index)) / 2;
  const auto a = FoundTowards(candidate.kept.index), b = FoundTowards(candidate.gone.index);
  const auto is_at_end = [&](const WallSpan& span, double along_m) {
    return std::min(std::abs(span.from_m - along_m), std::abs(span.to_m - along_m)) < kAtEnd_m;
  };
  for (const auto& [index, pieces] : spans) {
    const GraphLine& line = graph_.line(index);
    const double along_m = line.AlongTo(at);
    if (std::abs(line.AcrossTo(at)) > kAtEnd_m ||
        std::none_of(pieces.begin(), pieces.end(), [&](const auto& p) { return is_at_end(p, along_m); }))
      continue;
    for (const Vector2d& one : a)
      for (const Vector2d& other : b)
        if (line.left().dot(one) * line.left().dot(other) < 0) return false;
  }
  return true;
}

void FloorGraph::AddPointCandidates(const std::map<int, std::vector<WallSpan>>& spans,
                                    std::vector<Candidate>& found) const {
  const std::set<int> tied = TiedPoints();
  int looked = 0;
  for (auto i = tied.begin(); i != tied.end(); ++i)
    for (auto k = std::next(i); k != tied.end() && looked < kMostPairs; ++k) {
      const auto candidate = PointCandidate(*i, *k);
      if (candidate) ++looked;
      if (!candidate || candidate->distance > config_.gate || AreHeardTogether(*i, *k)) continue;
      if (!apart_.contains({candidate->kept, candidate->gone}) && AreOnOneSide(*candidate, spans))
        found.push_back(*candidate);
    }
}

/// Whether a third point, elsewhere, could be meant in place of either.
bool FloorGraph::IsAmbiguousPoint(const Candidate& candidate, const std::set<int>& tied) const {
  const auto is_rival = [&](int of, int other, int meant) {
    if (other == of || other == meant) return false;
    if ((graph_.point(other) - graph_.point(meant)).norm() < kOnePoint_m) return false;
    const auto rival = PointCandidate(std::min(of, other), std::max(of, other));
    return rival && rival->distance < candidate.distance + kRival;
  };
  const int kept = candidate.kept.index, gone = candidate.gone.index;
  return std::any_of(tied.begin(), tied.end(),
                     [&](int other) { return is_rival(kept, other, gone) || is_rival(gone, other, kept); });
}

/// Whether a pair needs no other one that agrees.
bool FloorGraph::IsKnownWell(const Candidate& candidate) const {
  if (candidate.kept.kind == GraphNode::Kind::kLine) return 3 * candidate.sigma_m <= config_.alone_m;
  return 3 * candidate.sigma_m <= config_.alone_m && candidate.error.norm() < kOnePoint_m;
}

}  // namespace priamos::planner
