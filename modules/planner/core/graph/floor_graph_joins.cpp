#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "planner/core/graph/floor_graph.hpp"

/// Which walls of the graph are one.
namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// Walls that are one face the same way, and are no farther apart than this, along them the width of a door.
constexpr double kSameFacing_rad = Radians(10), kMostAcross_m = 0.6, kMostGap_m = 2.0;
/// What two walls that are one differ by besides the graph's own errors: a wall is not quite straight.
constexpr double kUneven_m = 0.02, kUneven_rad = Radians(0.5);
/// A candidate that is farther off by so many sigmas is not meant.
constexpr double kAsGood = 2;
/// Candidates that lie so near to each other mean the same wall.
constexpr double kSame_m = 0.1;
/// What joining may cost more than before, for each pair: squared sigmas.
constexpr double kMostCost = 16;
/// 99 % of what four numbers do by chance, squared sigmas.
constexpr double kFour = 13.3;

}  // namespace

Vector2d FloorGraph::UnevenOf(const GraphNode& node) {
  return node.kind == GraphNode::Kind::kPoint ? Vector2d(kUneven_m, kUneven_m)
                                              : Vector2d(kUneven_m, kUneven_rad);
}

/// Where two walls are nearest along the first; nullopt: nowhere.
std::optional<double> FloorGraph::Meet(const GraphLine& a, const std::vector<WallSpan>& own,
                                       const GraphLine& b, const std::vector<WallSpan>& others) {
  double least_gap_m = kMostGap_m;
  std::optional<double> at_m;
  for (const WallSpan& piece : own)
    for (const WallSpan& other : others) {
      const double from_m = a.AlongTo(b.At(other.from_m)), to_m = a.AlongTo(b.At(other.to_m));
      const double begin_m = std::max(piece.from_m, from_m), end_m = std::min(piece.to_m, to_m);
      if (begin_m - end_m >= least_gap_m) continue;
      least_gap_m = begin_m - end_m;
      at_m = (begin_m + end_m) / 2;
    }
  return at_m;
}

/// The pair as it is seen at a place along the first wall.
std::optional<FloorGraph::Candidate> FloorGraph::CandidateAt(int kept, int gone, double at_m) const {
  const GraphLine &a = graph_.line(kept), &b = graph_.line(gone);
  const double on_b_m = b.AlongTo(a.At(at_m));
  const Vector2d place = b.At(on_b_m);
  Candidate candidate;
  candidate.kept = {GraphNode::Kind::kLine, kept};
  candidate.gone = {GraphNode::Kind::kLine, gone};
  candidate.error << a.AcrossTo(place), WrapAngle(b.yaw_rad - a.yaw_rad);
  if (std::abs(candidate.error(0)) > kMostAcross_m) return std::nullopt;
  const auto covariance = graph_.CovarianceOf({candidate.kept, candidate.gone});
  if (!covariance) return std::nullopt;
  candidate.by << -a.AlongTo(place), -1, on_b_m, 1, -1, 0, 1, 0;
  Eigen::Matrix2d spread = candidate.by * *covariance * candidate.by.transpose();
  spread.diagonal() += UnevenOf(candidate.kept).cwiseAbs2();
  candidate.sigma_m = std::sqrt(spread(0, 0));
  candidate.distance = std::sqrt(candidate.error.dot(spread.ldlt().solve(candidate.error)));
  return candidate;
}

std::vector<FloorGraph::Candidate> FloorGraph::Candidates() const {
  std::vector<Candidate> found;
  const auto spans = Spans();
  for (auto i = spans.begin(); i != spans.end(); ++i)
    for (auto k = std::next(i); k != spans.end(); ++k) {
      const GraphLine &a = graph_.line(i->first), &b = graph_.line(k->first);
      if (std::abs(WrapAngle(b.yaw_rad - a.yaw_rad)) > kSameFacing_rad) continue;
      if (apart_.contains({{GraphNode::Kind::kLine, i->first}, {GraphNode::Kind::kLine, k->first}})) continue;
      const auto at_m = Meet(a, i->second, b, k->second);
      if (!at_m) continue;
      const auto candidate = CandidateAt(i->first, k->first, *at_m);
      if (candidate && candidate->distance <= config_.apart) found.push_back(*candidate);
    }
  if (config_.points) AddPointCandidates(spans, found);
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.distance < b.distance; });
  return found;
}

/// Whether another wall, elsewhere, could be meant as well.
bool FloorGraph::IsAmbiguous(const Candidate& candidate, const std::vector<Candidate>& all) {
  return std::any_of(all.begin(), all.end(), [&](const Candidate& other) {
    const bool same_pair = other.kept == candidate.kept && other.gone == candidate.gone;
    const bool shares = other.kept == candidate.kept || other.gone == candidate.gone ||
                        other.kept == candidate.gone || other.gone == candidate.kept;
    const bool as_good = other.distance < candidate.distance + kAsGood;
    return !same_pair && shares && as_good &&
           std::abs(std::abs(other.error(0)) - std::abs(candidate.error(0))) > kSame_m;
  });
}

/// Whether two pairs are off by what the same error of the poses explains.
bool FloorGraph::Agree(const Candidate& a, const Candidate& b) const {
  const auto covariance = graph_.CovarianceOf({a.kept, a.gone, b.kept, b.gone});
  if (!covariance) return false;
  Eigen::Matrix<double, 4, 8> by = Eigen::Matrix<double, 4, 8>::Zero();
  by.topLeftCorner<2, 4>() = a.by;
  by.bottomRightCorner<2, 4>() = b.by;
  Eigen::Vector4d error;
  error << a.error, b.error;
  Eigen::Matrix4d spread = by * *covariance * by.transpose();
  spread.diagonal() += (Eigen::Vector4d() << UnevenOf(a.kept), UnevenOf(b.kept)).finished().cwiseAbs2();
  return error.dot(spread.ldlt().solve(error)) < kFour;
}

/// Joins what is surest; false: nothing is sure.
bool FloorGraph::JoinOnce() {
  const auto all = Candidates();
  const std::set<int> tied = TiedPoints();
  std::vector<Candidate> doubtful;
  for (const Candidate& candidate : all) {
    const bool is_point = candidate.kept.kind == GraphNode::Kind::kPoint;
    if (candidate.distance > config_.gate) continue;
    if (is_point ? IsAmbiguousPoint(candidate, tied) : IsAmbiguous(candidate, all)) continue;
    if (!IsKnownWell(candidate)) {
      doubtful.push_back(candidate);
    } else if (Join({candidate})) {
      return true;
    }
  }
  return JoinTogether(doubtful);
}

bool FloorGraph::JoinTogether(const std::vector<Candidate>& found) {
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t k = i + 1; k < found.size(); ++k) {
      const Candidate &a = found[i], &b = found[k];
      const bool apart = a.kept != b.kept && a.gone != b.gone && a.kept != b.gone && a.gone != b.kept;
      if (apart && Agree(a, b) && Join({a, b})) return true;
    }
  return false;
}

/// What was told of one node is of another from now on.
void FloorGraph::Rename(const GraphNode& kept, const GraphNode& gone) {
  if (kept.kind == GraphNode::Kind::kPoint) {
    for (auto& [name, told] : points_)
      if (told.sight.point == gone.index) told.sight.point = kept.index;
    return;
  }
  for (auto& [name, told] : told_)
    if (told.line == gone.index) told.line = kept.index;
}

/// Tries it: what costs too much is undone, and not tried again.
bool FloorGraph::Join(const std::vector<Candidate>& pairs) {
  const PoseGraph before = graph_;
  const double cost = graph_.CostOf();
  for (const Candidate& pair : pairs)
    if (pair.kept.kind == GraphNode::Kind::kLine)
      graph_.Join(pair.kept.index, pair.gone.index);
    else
      graph_.JoinPoints(pair.kept.index, pair.gone.index);
  graph_.FollowAll();
  if (graph_.Adjust() > cost + kMostCost * static_cast<double>(pairs.size())) {
    graph_ = before;
    for (const Candidate& pair : pairs) apart_.insert({pair.kept, pair.gone});
    refused_ += static_cast<int>(pairs.size());
    return false;
  }
  for (const Candidate& pair : pairs) Rename(pair.kept, pair.gone);
  loops_ += static_cast<int>(pairs.size());
  return true;
}

}  // namespace priamos::planner
