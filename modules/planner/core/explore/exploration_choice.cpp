#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/cross.hpp"
#include "planner/core/explore/exploration.hpp"
#include "planner/core/explore/frontier_tour.hpp"

// Which frontier is next, and why the others are left.

namespace priamos::planner {
namespace {

using Cell = ExploredGrid::Cell;
using Eigen::Vector2d;
using Eigen::Vector2i;

/// In which direction a frontier leads is seen from what is unknown so near.
constexpr int kOutwardCells = 5;
/// Openings are not wider.
constexpr double kWidest_m = 2.2;
/// A round that has seen so much more has found a room.
constexpr double kRoom_m2 = 5;

}  // namespace

std::optional<FrontierGoal> Exploration::Choose(const Pose2& map_from_base) {
  left_.clear();
  // A room that was missed is looked at as all others were.
  if (again_ && grid().free_m2() > again_from_m2_ + kRoom_m2) again_ = false;
  const GridWays ways(grid(), map_from_base.translation(), clearance_m_);
  possible();
  std::vector<Candidate> candidates;
  for (const Frontier& frontier : FrontiersOf(*grid_, config_.least_frontier_m)) {
    if (const auto candidate = Best(frontier, ways, map_from_base))
      candidates.push_back(*candidate);
    else if (!IsCrumb(frontier))
      left_.push_back({frontier.middle, frontier.length_m(), WhyLeft(frontier, ways)});
  }
  std::stable_sort(left_.begin(), left_.end(),
                   [](const auto& a, const auto& b) { return a.length_m > b.length_m; });
  if (candidates.empty()) return std::nullopt;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.cost < b.cost; });
  return candidates[config_.rule == "tour" ? FirstOf(candidates, ways) : 0].goal;
}

/// The first on the shortest way over the nearest of them: what is left behind has to be come back to.
std::size_t Exploration::FirstOf(const std::vector<Candidate>& candidates, const GridWays& ways) {
  const std::size_t n = std::min(candidates.size(), kMostTourPlaces);
  std::vector<double> to;
  std::vector<Vector2i> cells;
  for (std::size_t i = 0; i < n; ++i) {
    to.push_back(std::max(0.0, candidates[i].cost));
    cells.push_back(candidates[i].cell);
  }
  Eigen::MatrixXd between(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = ways.WaysFrom(cells[i], cells);
    for (std::size_t k = 0; k < n; ++k) between(Eigen::Index(i), Eigen::Index(k)) = row[k];
  }
  return FirstOfTour(to, between);
}

/// The place of a frontier that costs least; nullopt: none can be reached.
std::optional<Exploration::Candidate> Exploration::Best(const Frontier& frontier, const GridWays& ways,
                                                        const Pose2& base) const {
  std::optional<Candidate> best;
  for (const Vector2i& at : frontier.cells) {
    const Vector2d place = grid_->PlaceOf(at.x(), at.y());
    if (!std::isfinite(ways.Way_m(at)) || ways.Clearance_m(at) < clearance_m_) continue;
    if (ways.Way_m(at) > MostWay_m() && !IsBehindOpening(place)) continue;
    if ((place - evidence_.trail.front()).norm() > config_.farthest_m || FindGivenUp(place)) continue;
    const double cost = CostOf(frontier, at, ways, base);
    if (best && cost >= best->cost) continue;
    const double gain_m2 = Gain_m2(at);
    if (gain_m2 < LeastGain_m2(ways.Way_m(at))) continue;
    best = Candidate{{place, place, ways.Way_m(at), frontier.length_m(), gain_m2}, at, cost};
  }
  if (!best) return std::nullopt;
  best->goal.goal = GoalBeyond(best->cell, ways);
  if (config_.rule == "nearest") best->cost = ways.Way_m(best->cell);
  return best;
}

double Exploration::CostOf(const Frontier& frontier, const Vector2i& cell, const GridWays& ways,
                           const Pose2& base) const {
  const Vector2d place = grid_->PlaceOf(cell.x(), cell.y());
  if (config_.rule == "nearest") return (place - frontier.middle).norm();
  const Vector2d there = base.Inverse() * place;
  const double turn_rad = std::abs(std::atan2(there.y(), there.x()));
  return ways.Way_m(cell) + config_.turn_m * turn_rad +
         config_.tight_m * std::max(0.0, config_.roomy_m - ways.Clearance_m(cell)) -
         config_.length_gain * std::min(config_.most_length_m, frontier.length_m());
}

/// What a look at a border may bring; once nothing else is left, what a drive there may.
double Exploration::Gain_m2(const Vector2i& cell) const {
  return again_ ? possible_->Region_m2(cell) : possible_->Behind_m2(cell);
}

/// Whether the straight line from where the base was nearest to a place leads between two edges that were
/// heard, as far apart as those of an opening: then a room is behind it, and not the gap between two pieces
/// of a wall.
bool Exploration::IsBehindOpening(const Vector2d& place) const {
  const auto& trail = evidence_.trail;
  const Vector2d from = *std::min_element(trail.begin(), trail.end(), [&](const auto& a, const auto& b) {
    return (a - place).squaredNorm() < (b - place).squaredNorm();
  });
  const auto& points = evidence_.walls.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = i + 1; k < points.size(); ++k) {
      const Vector2d a = points[i].at(), b = points[k].at();
      const double width_m = (b - a).norm();
      if (width_m < 2 * clearance_m_ || width_m > kWidest_m) continue;
      const auto side = [](const Vector2d& p, const Vector2d& q, const Vector2d& of) {
        return Cross(q - p, of - p) > 0;
      };
      if (side(a, b, from) != side(a, b, place) && side(from, place, a) != side(from, place, b)) return true;
    }
  return false;
}

/// Whether there is next to nothing behind all of it: the corner of a room, between walls that are known.
bool Exploration::IsCrumb(const Frontier& frontier) const {
  return std::all_of(frontier.cells.begin(), frontier.cells.end(), [&](const Vector2i& cell) {
    double behind_m2 = 0;
    VisitUnknownBehind(*grid_, cell, kLeastReach_m,
                       [&](const Vector2i&, double share_m2) { behind_m2 += share_m2; });
    return behind_m2 < config_.least_gain_m2;
  });
}

std::string Exploration::WhyLeft(const Frontier& frontier, const GridWays& ways) const {
  double widest_m = 0, nearest_m = std::numeric_limits<double>::infinity();
  bool near_enough = false;
  for (const Vector2i& at : frontier.cells) {
    const Vector2d place = grid_->PlaceOf(at.x(), at.y());
    if (const GivenUp* given = FindGivenUp(place)) return given->reason;
    widest_m = std::max(widest_m, 2 * ways.Clearance_m(at));
    nearest_m = std::min(nearest_m, ways.Way_m(at));
    near_enough = near_enough || (place - evidence_.trail.front()).norm() <= config_.farthest_m;
  }
  if (!near_enough) return fmt::format("farther than {:.0f} m from the start", config_.farthest_m);
  if (widest_m < 2 * clearance_m_)
    return fmt::format("{:.1f} m wide, {:.2f} m needed", widest_m, 2 * (clearance_m_ + kRaster_m));
  const bool some = std::any_of(frontier.cells.begin(), frontier.cells.end(), [&](const Vector2i& at) {
    return possible_->Behind_m2(at) >= config_.least_gain_m2;
  });
  if (std::isfinite(nearest_m) && nearest_m > MostWay_m())
    return fmt::format("{:.0f} m away, too far for what may be behind it", nearest_m);
  if (again_ && some) return "tried before, and little can be behind it";
  return fmt::format("no way of {:.2f} m width leads there", 2 * (clearance_m_ + kRaster_m));
}

/// The direction in which most is unknown around a cell, of length 1; zero when that is even.
Vector2d Exploration::Outward(const Vector2i& cell) const {
  Vector2d sum(0, 0);
  for (int dx = -kOutwardCells; dx <= kOutwardCells; ++dx)
    for (int dy = -kOutwardCells; dy <= kOutwardCells; ++dy)
      if (grid_->At(cell.x() + dx, cell.y() + dy) == Cell::kUnknown) sum += Vector2d(dx, dy);
  return sum.norm() > 1 ? Vector2d(sum.normalized()) : Vector2d(0, 0);
}

/// As far beyond the frontier as nothing is known to be near.
Vector2d Exploration::GoalBeyond(const Vector2i& cell, const GridWays& ways) const {
  const Vector2d target = grid_->PlaceOf(cell.x(), cell.y()), outward = Outward(cell);
  Vector2d goal = target;
  for (double by_m = ExploredGrid::kStep_m; by_m <= config_.beyond_m + 1e-9; by_m += ExploredGrid::kStep_m) {
    const Vector2d next = target + by_m * outward;
    const Vector2i at = grid_->CellOf(next);
    if (!grid_->Holds(at.x(), at.y()) || ways.Clearance_m(at) < clearance_m_) break;
    goal = next;
  }
  return goal;
}

}  // namespace priamos::planner
