#include "head/core/edges/segment_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include "common/geometry.hpp"
#include "head/core/edges/segment_index.hpp"

namespace priamos::head {
namespace {

constexpr double kCell_px = 64;
constexpr double kSigmas = 3;
constexpr double kMaxAngleNoise = 0.03;  ///< largest error of a direction that is searched for [rad]
/// Lines are looked up among those of about their direction.
constexpr int kSectors = 16;

/// A total order of segments that depends on where they are, not on where they stand in a list.
auto Place(const EdgeSegment& s) {
  return std::tuple<const double&, const double&, const double&, const double&>(s.begin.x(), s.begin.y(),
                                                                                s.end.x(), s.end.y());
}

/// Distance of the ends of `piece` from `line`, in units of the allowed distance.
double Deviation(const EdgeSegment& line, const EdgeSegment& piece, const FusionOptions& options) {
  const Eigen::Vector2d normal = line.normal(), along = piece.direction();
  double worst = 0;
  for (const Eigen::Vector2d& end : {piece.begin, piece.end}) {
    const double sigma = piece.SigmaAt(along.dot(end - piece.centre));
    const double allowed = options.max_distance_px + kSigmas * std::min(sigma, 0.5);
    worst = std::max(worst, std::abs(normal.dot(end - line.centre)) / allowed);
  }
  return worst;
}

struct Line {
  EdgeSegment segment;
  int first_piece, last_piece;  ///< a list through Fuser::next_piece_
  bool alive = true;
  int seen_by = -1;  ///< last line that has been compared with it
  // What every comparison needs.
  Eigen::Vector2d direction = segment.direction();
  double length_px = segment.length_px();
};

/// Cheap reasons why `a` and `b` are not pieces of one edge; else the gap between them [px].
std::optional<double> Gap(const Line& a, const Line& b, const FusionOptions& options) {
  const Eigen::Vector2d &u = a.direction, &v = b.direction;
  if (u.dot(v) < 0.9) return std::nullopt;
  const double noise = std::min(a.segment.sigma_angle_rad + b.segment.sigma_angle_rad, kMaxAngleNoise);
  if (std::abs(u.x() * v.y() - u.y() * v.x()) > options.max_angle_rad + kSigmas * noise) return std::nullopt;
  const double beside = std::abs(u.x() * (b.segment.centre - a.segment.centre).y() -
                                 u.y() * (b.segment.centre - a.segment.centre).x());
  const double reach = a.length_px + b.length_px + options.max_gap_px;
  if (beside > options.max_distance_px + kSigmas + (options.max_angle_rad + kSigmas * noise) * reach)
    return std::nullopt;
  const double gap = std::max(u.dot(b.segment.begin - a.segment.end), u.dot(a.segment.begin - b.segment.end));
  const double shorter = std::min(a.length_px, b.length_px);
  if (gap > std::min(options.max_gap_px, options.max_gap_share * shorter)) return std::nullopt;
  const double contrast = a.segment.contrast() / b.segment.contrast();
  if (contrast > options.max_grey_ratio || contrast * options.max_grey_ratio < 1) return std::nullopt;
  return gap;
}

class Fuser {
 public:
  Fuser(const FusionOptions& options, const EdgeImage& edges)
      : options_(options),
        index_(kSectors, SegmentIndex(edges.width, edges.height, kCell_px)),
        pieces_(edges.segments) {
    lines_.reserve(2 * pieces_.size());
    for (const EdgeSegment& s : pieces_) Add({s, int(lines_.size()), int(lines_.size())});
    next_piece_.assign(lines_.size(), -1);
  }

  void Run() {
    while (!pairs_.empty()) {
      const Pair pair = pairs_.top();
      pairs_.pop();
      if (lines_[pair.first].alive && lines_[pair.second].alive) TryToJoin(pair);
    }
  }

  /// The lines left over, with the points of their pieces one after the other.
  void Store(EdgeImage& edges) const {
    std::vector<EdgePoint> points;
    std::vector<EdgeSegment> segments;
    points.reserve(edges.points.size());
    segments.reserve(pieces_.size());
    for (const Line& line : lines_) {
      if (!line.alive) continue;
      EdgeSegment segment = line.segment;
      segment.first_point = static_cast<int>(points.size());
      for (int p = line.first_piece; p >= 0; p = next_piece_[p]) {
        const auto begin = edges.points.begin() + pieces_[p].first_point;
        points.insert(points.end(), begin, begin + pieces_[p].n_points);
      }
      segment.n_points = static_cast<int>(points.size()) - segment.first_point;
      segments.push_back(segment);
    }
    edges.points = std::move(points);
    edges.segments = std::move(segments);
  }

  bool HasJoined() const { return lines_.size() > pieces_.size(); }

 private:
  struct Pair {
    double cost;
    std::tuple<double, double, double, double> first_place, second_place;
    int first, second;

    bool operator>(const Pair& other) const {
      return std::tie(cost, first_place, second_place) >
             std::tie(other.cost, other.first_place, other.second_place);
    }
  };

  void Add(const Line& line) {
    const int id = static_cast<int>(lines_.size());
    const double turn = std::atan2(line.direction.y(), line.direction.x()) * kSectors / (2 * kPi) + kSectors;
    const double reach = (options_.max_angle_rad + kSigmas * kMaxAngleNoise) * kSectors / (2 * kPi);
    near_.clear();
    for (int sector = int(turn - reach); sector <= int(turn + reach); ++sector) {
      FindAround(line, index_[sector % kSectors]);
    }
    index_[int(turn) % kSectors].Insert(id, line.segment.begin, line.segment.end);
    lines_.push_back(line);
    for (const int other : near_) {
      if (!lines_[other].alive || lines_[other].seen_by == id) continue;
      lines_[other].seen_by = id;
      Consider(id, other);
    }
  }

  void FindAround(const Line& line, const SegmentIndex& index) {
    index.Near(line.segment.begin, options_.max_gap_px, near_);
    index.Near(line.segment.end, options_.max_gap_px, near_);
    // A long line may run past a short one without an end near it.
    for (double at = kCell_px; at < line.length_px; at += kCell_px) {
      index.Near(line.segment.begin + at * line.direction, 1, near_);
    }
  }

  void Consider(int a, int b) {
    if (Place(lines_[b].segment) < Place(lines_[a].segment)) std::swap(a, b);
    const auto gap = Gap(lines_[a], lines_[b], options_);
    if (!gap) return;
    const EdgeSegment &first = lines_[a].segment, &second = lines_[b].segment;
    const EdgeSegment joined = JoinFits(first, second);
    const double deviation =
        std::max(Deviation(joined, first, options_), Deviation(joined, second, options_));
    if (deviation > 1) return;
    pairs_.push({std::max(*gap, 0.0) / options_.max_gap_px + deviation, Place(first), Place(second), a, b});
  }

  void TryToJoin(const Pair& pair) {
    Line &first = lines_[pair.first], &second = lines_[pair.second];
    Line joined{JoinFits(first.segment, second.segment), first.first_piece, second.last_piece};
    for (const Line* part : {&first, &second}) {
      for (int p = part->first_piece; p >= 0; p = next_piece_[p]) {
        if (Deviation(joined.segment, pieces_[p], options_) > 1) return;
      }
    }
    first.alive = second.alive = false;
    next_piece_[first.last_piece] = second.first_piece;
    Add(joined);
  }

  FusionOptions options_;
  std::vector<SegmentIndex> index_;         ///< the lines, by sector of their directions
  const std::vector<EdgeSegment>& pieces_;  ///< all pieces of the image
  std::vector<int> next_piece_;
  std::vector<Line> lines_;  ///< the pieces, then every line that was joined
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> pairs_;
  std::vector<int> near_;
};

/// Two fits in the frame of the line that joins them: along it and beside it [px].
struct PairOfFits {
  double w[2], t[2], y[2], spread[2], slope[2];  ///< weight, place along, beside, weight of the slope, slope
  double from = 1e9, to = -1e9;                  ///< ends along the line
};

PairOfFits InFrame(const EdgeSegment& first, const EdgeSegment& second, const Eigen::Vector2d& d,
                   const Eigen::Vector2d& n) {
  const EdgeSegment* const parts[2] = {&first, &second};
  const Eigen::Vector2d origin = first.centre;
  PairOfFits p;
  for (int i = 0; i < 2; ++i) {
    const EdgeSegment& s = *parts[i];
    p.w[i] = 1 / (s.sigma_normal_px * s.sigma_normal_px);
    p.spread[i] = 1 / (s.sigma_angle_rad * s.sigma_angle_rad);
    p.t[i] = d.dot(s.centre - origin);
    p.y[i] = n.dot(s.centre - origin);
    p.slope[i] = n.dot(s.direction()) / d.dot(s.direction());
    p.from = std::min(p.from, d.dot(s.begin - origin));
    p.to = std::max(p.to, d.dot(s.end - origin));
  }
  return p;
}

/// The line through both: its middle along, its offset there and slope, with their weights and the residual.
struct JoinedFit {
  double mean = 0, offset = 0, turn = 0, weight = 0, total = 0, chi2 = 0;
};

JoinedFit Fit(const PairOfFits& p) {
  JoinedFit fit;
  fit.weight = p.w[0] + p.w[1];
  fit.mean = (p.w[0] * p.t[0] + p.w[1] * p.t[1]) / fit.weight;
  fit.offset = (p.w[0] * p.y[0] + p.w[1] * p.y[1]) / fit.weight;
  fit.total = p.spread[0] + p.spread[1];
  double moment = p.spread[0] * p.slope[0] + p.spread[1] * p.slope[1];
  for (int i = 0; i < 2; ++i) {
    fit.total += p.w[i] * (p.t[i] - fit.mean) * (p.t[i] - fit.mean);
    moment += p.w[i] * (p.t[i] - fit.mean) * (p.y[i] - fit.offset);
  }
  fit.turn = moment / fit.total;
  for (int i = 0; i < 2; ++i) {
    const double error = p.y[i] - fit.offset - fit.turn * (p.t[i] - fit.mean);
    fit.chi2 += p.w[i] * error * error + p.spread[i] * (p.slope[i] - fit.turn) * (p.slope[i] - fit.turn);
  }
  return fit;
}

}  // namespace

EdgeSegment JoinFits(const EdgeSegment& first, const EdgeSegment& second) {
  const Eigen::Vector2d d =
      (first.length_px() * first.direction() + second.length_px() * second.direction()).normalized();
  const Eigen::Vector2d n(-d.y(), d.x());
  const PairOfFits pair = InFrame(first, second, d, n);
  const JoinedFit fit = Fit(pair);
  const double inflation = std::sqrt(std::max(1.0, fit.chi2 / 2));  // four numbers for two unknowns
  const auto at = [&](double along) -> Eigen::Vector2d {
    return first.centre + along * d + (fit.offset + fit.turn * (along - fit.mean)) * n;
  };
  EdgeSegment joined;
  joined.begin = at(pair.from);
  joined.end = at(pair.to);
  joined.centre = at(fit.mean);
  joined.sigma_normal_px = inflation / std::sqrt(fit.weight);
  joined.sigma_angle_rad = inflation / std::sqrt(fit.total);
  const double share = first.length_px() / (first.length_px() + second.length_px());
  joined.grey_left = share * first.grey_left + (1 - share) * second.grey_left;
  joined.grey_right = share * first.grey_right + (1 - share) * second.grey_right;
  return joined;
}

void FuseSegments(const FusionOptions& options, EdgeImage& edges) {
  Fuser fuser(options, edges);
  fuser.Run();
  if (fuser.HasJoined()) fuser.Store(edges);
}

}  // namespace priamos::head
